//! Rules about Rust files: lengths, leftovers, and what a `lib.rs` holds.

use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::{
    Block, ImplItemFn, Item, ItemFn, Signature, TraitItemFn, Visibility,
    visit::{self, Visit},
};

use super::finding::{Exception, Finding};
use crate::tree::Tree;

const FUNCTION_LINES: usize = 70;
const FILE_LINES: usize = 500;

pub(super) fn check(tree: &Tree, exceptions: &[Exception], findings: &mut Vec<Finding>) {
    let mut needed = vec![false; exceptions.len()];
    for (path, text) in tree.texts(&["rs"]) {
        let file = match syn::parse_file(text) {
            Ok(file) => file,
            Err(error) => {
                let (line, message) = (error.span().start().line, format!("cannot be parsed: {error}"));
                findings.push(Finding { file: path.to_owned(), line, message });
                continue;
            }
        };
        let mut lengths = Lengths { found: vec![(None, 0, text.lines().count())] };
        lengths.visit_file(&file);
        for (function, line, lines) in lengths.found {
            let longest = if function.is_some() { FUNCTION_LINES } else { FILE_LINES };
            let exception = exceptions.iter().position(|exception| {
                path == Path::new(exception.file) && exception.function == function.as_deref()
            });
            if let Some(exception) = exception {
                needed[exception] |= lines > longest;
            }
            let allowed = exception.map_or(longest, |exception| exceptions[exception].lines);
            if lines > allowed {
                let message = too_long(function.as_deref(), lines, allowed);
                findings.push(Finding { file: path.to_owned(), line, message });
            }
        }
        leftovers(path, text.parse().unwrap_or_default(), findings);
        if path.ends_with("src/lib.rs") {
            check_lib(path, text, &file, findings);
        }
    }
    for (exception, _) in exceptions.iter().zip(needed).filter(|(_, needed)| !needed) {
        let place = exception.function.map_or(String::new(), |function| format!(" for `{function}`"));
        let message = format!("the exception{place} is not needed any more: the list is to shrink");
        findings.push(Finding { file: exception.file.into(), line: 0, message });
    }
}

fn too_long(function: Option<&str>, lines: usize, allowed: usize) -> String {
    match function {
        Some(name) => format!(
            "`{name}` has {lines} lines, at most {allowed}: a function that does not fit on a screen is not \
             seen as a whole"
        ),
        None => {
            format!("{lines} lines, at most {allowed}: a file should have one subject; split it by subjects")
        }
    }
}

/// The name, the first line and the number of lines of each function, without documentation and attributes.
struct Lengths {
    found: Vec<(Option<String>, usize, usize)>,
}

impl Lengths {
    fn add(&mut self, signature: &Signature, body: &Block) {
        let first = signature.fn_token.span.start().line;
        let last = body.brace_token.span.close().end().line;
        self.found.push((Some(signature.ident.to_string()), first, last - first + 1));
    }
}

impl<'ast> Visit<'ast> for Lengths {
    fn visit_item_fn(&mut self, item: &'ast ItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast ImplItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast TraitItemFn) {
        if let Some(body) = &item.default {
            self.add(&item.sig, body);
        }
        visit::visit_trait_item_fn(self, item);
    }
}

/// Finds macros and attributes of unfinished code. It looks at tokens, so that comments and strings may name
/// them.
fn leftovers(path: &Path, tokens: TokenStream, findings: &mut Vec<Finding>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (at, token) in tokens.iter().enumerate() {
        let next = tokens.get(at + 1);
        let line = token.span().start().line;
        let mut find = |message: String| findings.push(Finding { file: path.to_owned(), line, message });
        match (token, next) {
            (TokenTree::Ident(name), Some(TokenTree::Punct(mark)))
                if mark.as_char() == '!'
                    && ["todo", "unimplemented", "dbg"].iter().any(|macro_name| name == macro_name) =>
            {
                find(format!("`{name}!`: what is committed is finished"));
            }
            (TokenTree::Punct(mark), Some(TokenTree::Group(group)))
                if mark.as_char() == '#'
                    && group.delimiter() == Delimiter::Bracket
                    && names(group.stream(), "ignore") =>
            {
                find("an ignored test: a test that does not run proves nothing".to_owned());
            }
            _ => {}
        }
        if let TokenTree::Group(group) = token {
            leftovers(path, group.stream(), findings);
        }
    }
}

/// Whether an identifier occurs among tokens, however deep.
fn names(tokens: TokenStream, name: &str) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == name,
        TokenTree::Group(group) => names(group.stream(), name),
        _ => false,
    })
}

fn check_lib(path: &Path, text: &str, file: &syn::File, findings: &mut Vec<Finding>) {
    let mut find = |line, message: &str| {
        findings.push(Finding { file: path.to_owned(), line, message: message.to_owned() });
    };
    if !text.starts_with("//!") {
        find(1, "does not begin with `//!`: a crate's first words are its story");
    }
    for item in &file.items {
        let listed = match item {
            Item::Mod(module) => module.content.is_none(),
            Item::Use(import) => matches!(import.vis, Visibility::Public(_)),
            Item::ExternCrate(_) => true,
            _ => false,
        };
        if !listed {
            let line = syn::spanned::Spanned::span(item).start().line;
            find(
                line,
                "an item in lib.rs: it holds the story, `mod` lines and re-exports only, to be read as a \
                 table of contents",
            );
        }
    }
}
