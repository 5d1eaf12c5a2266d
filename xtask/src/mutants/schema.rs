//! A source text with all its mutants in it, of which at most one is active when it runs.
//!
//! An expression `a < b` becomes the following. The mutants' arms hold the text as it was: since one mutant
//! at most is active, those of its parts need no place in them. So nothing is moved, borrowed or evaluated
//! otherwise than before, and the text grows by its depth at most.
//!
//! ```text
//! (match ::mutant::at(7) { 7 => { (a) == (b) } 8 => { (a) > (b) } _ => (a < b)})
//! ```

use std::{
    cmp::Reverse,
    collections::{HashMap, HashSet},
    ops::Range,
};

use proc_macro2::Span;
use syn::{
    Arm, BinOp, Block, Expr, ExprBinary, ExprMatch, ExprStruct, ExprUnary, ImplItemFn, ItemFn, Pat,
    ReturnType, Signature, TraitItemFn, TypeImplTrait,
    spanned::Spanned,
    visit::{self, Visit},
};

use super::list::{Genre, Mutant};

/// A place of a source text that mutants change, in the text with all of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Site {
    /// The mutants, with their own parts of the text.
    pub(super) arms: Vec<(u32, Range<usize>)>,
    /// The whole place.
    pub(super) whole: Range<usize>,
}

/// A text with all its mutants.
#[derive(Clone, Debug, Default)]
pub(super) struct Schema {
    pub(super) text: String,
    pub(super) sites: Vec<Site>,
}

/// A text to be inserted at a byte of the source.
#[derive(Debug)]
struct Insertion {
    at: usize,
    /// Ends of inner expressions come first, and starts of outer ones.
    order: (bool, usize),
    text: String,
    site: usize,
    /// The arms of mutants in the text.
    arms: Vec<(u32, Range<usize>)>,
}

/// The source text with these mutants.
///
/// # Errors
/// The fault of a text that is not Rust.
pub(super) fn schema(source: &str, mutants: &[&Mutant]) -> syn::Result<Schema> {
    let file = syn::parse_file(source)?;
    let starts = line_starts(source);
    let mut of_start: HashMap<(Genre, usize), Vec<&Mutant>> = HashMap::new();
    for mutant in mutants {
        let start = byte_of(source, &starts, mutant.line, mutant.column);
        of_start.entry((mutant.genre, start)).or_default().push(mutant);
    }
    let mut writer = Writer { source, of_start, insertions: Vec::new(), order: 0, sites: 0 };
    writer.visit_file(&file);
    Ok(writer.text())
}

/// The first byte of each line.
fn line_starts(source: &str) -> Vec<usize> {
    std::iter::once(0).chain(source.match_indices('\n').map(|(at, _)| at + 1)).collect()
}

/// The byte of a line and column, both from 1, the latter in characters.
fn byte_of(source: &str, starts: &[usize], line: usize, column: usize) -> usize {
    let start = starts.get(line - 1).copied().unwrap_or(source.len());
    let offset = source[start..].char_indices().nth(column - 1).map_or(source.len() - start, |(at, _)| at);
    start + offset
}

struct Writer<'s> {
    source: &'s str,
    /// By the genre and the first byte of what changes.
    of_start: HashMap<(Genre, usize), Vec<&'s Mutant>>,
    insertions: Vec<Insertion>,
    order: usize,
    sites: usize,
}

impl<'s> Writer<'s> {
    fn take(&mut self, genre: Genre, span: Span) -> Vec<&'s Mutant> {
        self.of_start.remove(&(genre, span.byte_range().start)).unwrap_or_default()
    }

    fn next_site(&mut self) -> usize {
        self.sites += 1;
        self.sites
    }

    fn text_of(&self, span: Span) -> &'s str {
        &self.source[span.byte_range()]
    }

    fn insert(
        &mut self,
        at: usize,
        is_start: bool,
        site: usize,
        text: String,
        arms: Vec<(u32, Range<usize>)>,
    ) {
        self.order += 1;
        self.insertions.push(Insertion { at, order: (is_start, self.order), text, site, arms });
    }

    /// Wraps an expression: `visit` visits its parts, `changed` is the text of a mutant.
    fn wrap(
        &mut self,
        (span, before): (Span, &str),
        mutants: &[&Mutant],
        changed: impl Fn(&Mutant) -> String,
        visit: impl FnOnce(&mut Self),
    ) {
        if mutants.is_empty() {
            return visit(self);
        }
        let (site, range) = (self.next_site(), span.byte_range());
        let mut text = format!("{before}(match ::mutant::at({}) {{", mutants[0].id);
        let mut arms = Vec::new();
        for mutant in mutants {
            let begin = text.len();
            text += &format!(" {} => {{ {} }}", mutant.id, changed(mutant));
            arms.push((mutant.id, begin..text.len()));
        }
        text += " _ => (";
        self.insert(range.start, true, site, text, arms);
        visit(self);
        self.insert(range.end, false, site, ")})".to_owned(), Vec::new());
    }

    fn text(mut self) -> Schema {
        self.insertions.sort_by_key(|insertion| (insertion.at, insertion.order));
        let mut schema = Schema { text: String::new(), sites: vec![Site::default(); self.sites + 1] };
        let (mut from, mut seen) = (0, HashSet::new());
        for Insertion { at, text, site: id, arms, .. } in self.insertions {
            schema.text += &self.source[from..at];
            from = at;
            let (begin, site) = (schema.text.len(), &mut schema.sites[id]);
            schema.text += &text;
            if seen.insert(id) {
                site.whole.start = begin;
            }
            site.whole.end = schema.text.len();
            site.arms.extend(arms.into_iter().map(|(id, arm)| (id, begin + arm.start..begin + arm.end)));
        }
        schema.text += &self.source[from..];
        schema.sites.retain(|site| !site.whole.is_empty());
        // Of places within each other the inner one is found first.
        schema.sites.sort_by_key(|site| Reverse(site.whole.start));
        schema
    }
}

/// The pattern of an arm, and its condition.
fn pattern_and_guard(arm: &Arm) -> (&Pat, Option<&Expr>) {
    match &arm.pat {
        Pat::Guard(guarded) => (&guarded.pat, Some(&guarded.guard)),
        pattern => (pattern, None),
    }
}

/// Whether a type is of the kind `impl Trait`: a function returns one type of this kind, so that no mutant
/// can return another.
fn is_impl(output: &ReturnType) -> bool {
    struct Finder(bool);
    impl<'ast> Visit<'ast> for Finder {
        fn visit_type_impl_trait(&mut self, _: &'ast TypeImplTrait) {
            self.0 = true;
        }
    }
    let mut finder = Finder(false);
    finder.visit_return_type(output);
    finder.0
}

/// Whether a chain of conditions binds names, so that it can be a part of no other expression.
fn binds(expr: &Expr) -> bool {
    match expr {
        Expr::Let(_) => true,
        Expr::Binary(ExprBinary { left, op: BinOp::And(_), right, .. }) => binds(left) || binds(right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Writer<'_> {
    fn visit_expr_binary(&mut self, binary: &'ast ExprBinary) {
        let mut mutants = self.take(Genre::Binary, binary.op.span());
        if binds(&binary.left) || binds(&binary.right) {
            mutants.clear();
        }
        let (left, right) = (self.text_of(binary.left.span()), self.text_of(binary.right.span()));
        let changed = |mutant: &Mutant| format!("({left}) {} ({right})", mutant.replacement);
        self.wrap((binary.span(), ""), &mutants, changed, |writer| visit::visit_expr_binary(writer, binary));
    }

    fn visit_expr_unary(&mut self, unary: &'ast ExprUnary) {
        let mutants = self.take(Genre::Unary, unary.op.span());
        let operand = self.text_of(unary.expr.span()).to_owned();
        let visit = |writer: &mut Self| visit::visit_expr_unary(writer, unary);
        self.wrap((unary.span(), ""), &mutants, |_| operand.clone(), visit);
    }

    fn visit_expr_match(&mut self, expr: &'ast ExprMatch) {
        let mut deleted = Vec::new();
        for (number, arm) in expr.arms.iter().enumerate() {
            let mutants = self.take(Genre::Arm, pattern_and_guard(arm).0.span());
            deleted.extend(mutants.first().map(|mutant| (number, mutant.id)));
        }
        // One place for all arms, from the beginning to the end of the match: where an arm may not be
        // missing, the compiler says so of the whole.
        let place = deleted.first().map(|(_, id)| (self.next_site(), *id));
        let range = expr.span().byte_range();
        if let Some((site, _)) = place {
            self.insert(range.start, true, site, String::new(), Vec::new());
        }
        self.visit_expr(&expr.expr);
        for (number, arm) in expr.arms.iter().enumerate() {
            let id = deleted.iter().find(|(of, _)| *of == number).map(|(_, id)| *id);
            self.arm(arm, place.zip(id));
        }
        if let Some((site, _)) = place {
            self.insert(range.end, false, site, String::new(), Vec::new());
        }
    }

    fn visit_expr_struct(&mut self, expr: &'ast ExprStruct) {
        for field in &expr.fields {
            let mutants = self.take(Genre::Field, field.span());
            let (Some(rest), false) = (&expr.rest, mutants.is_empty()) else {
                self.visit_field_value(field);
                continue;
            };
            let (rest, name) = (self.text_of(rest.span()), self.text_of(field.member.span()));
            let changed = |_: &Mutant| format!("({rest}).{name}");
            let before = if field.colon_token.is_none() { format!("{name}: ") } else { String::new() };
            self.wrap((field.expr.span(), &before), &mutants, changed, |writer| {
                if field.colon_token.is_some() {
                    writer.visit_expr(&field.expr);
                }
            });
        }
        if let Some(rest) = &expr.rest {
            self.visit_expr(rest);
        }
    }

    fn visit_item_fn(&mut self, item: &'ast ItemFn) {
        self.values(&item.sig, &item.block);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast ImplItemFn) {
        self.values(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast TraitItemFn) {
        if let Some(block) = &item.default {
            self.values(&item.sig, block);
        }
        visit::visit_trait_item_fn(self, item);
    }
}

impl Writer<'_> {
    /// An arm, with its condition if a mutant deletes it: the place with its first mutant, and this mutant.
    fn arm(&mut self, arm: &Arm, deleted: Option<((usize, u32), u32)>) {
        let (pattern, guard) = pattern_and_guard(arm);
        self.visit_pat(pattern);
        let condition = |(place, id): (u32, u32)| {
            let text = format!("(::mutant::at({place}) != {id})");
            let whole = 0..text.len();
            (text, vec![(id, whole)])
        };
        match (deleted, guard) {
            (Some(((site, place), id)), Some(guard)) => {
                let (range, (text, arms)) = (guard.span().byte_range(), condition((place, id)));
                self.insert(range.start, true, site, format!("{text} && ("), arms);
                self.visit_guard(guard);
                self.insert(range.end, false, site, ")".to_owned(), Vec::new());
            }
            (Some(((site, place), id)), None) => {
                let (text, arms) = condition((place, id));
                self.insert(pattern.span().byte_range().end, false, site, format!(" if {text}"), arms);
            }
            (None, Some(guard)) => self.visit_guard(guard),
            (None, None) => {}
        }
        self.visit_expr(&arm.body);
    }

    /// The values that mutants of a function return, at its beginning.
    fn values(&mut self, signature: &Signature, block: &Block) {
        let Some(first) = block.stmts.first() else { return };
        let mutants = self.take(Genre::Value, first.span());
        if mutants.is_empty() || is_impl(&signature.output) {
            return;
        }
        let site = self.next_site();
        let mut text = format!("match ::mutant::at({}) {{", mutants[0].id);
        let mut arms = Vec::new();
        for mutant in &mutants {
            let begin = text.len();
            text += &format!(" {} => {{ return {}; }}", mutant.id, mutant.replacement);
            arms.push((mutant.id, begin..text.len()));
        }
        text += " _ => {} } ";
        self.insert(first.span().byte_range().start, true, site, text, arms);
    }

    fn visit_guard(&mut self, guard: &Expr) {
        let mutants = self.take(Genre::Guard, guard.span());
        let changed = |mutant: &Mutant| mutant.replacement.clone();
        self.wrap((guard.span(), ""), &mutants, changed, |writer| writer.visit_expr(guard));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mutant(id: u32, source: &str, at: &str, genre: Genre, replacement: &str) -> Mutant {
        let byte = source.find(at).expect("it is in the source");
        let line = source[..byte].matches('\n').count() + 1;
        let column = source[..byte].chars().rev().take_while(|&letter| letter != '\n').count() + 1;
        let (file, change) = (String::new(), String::new());
        Mutant { id, file, line, column, genre, replacement: replacement.to_owned(), change, group: "" }
    }

    /// The text with mutants, each given by the beginning of its place; their arms are what they say.
    fn text(source: &str, changes: &[(&str, Genre, &str)]) -> String {
        let mutants: Vec<Mutant> = changes
            .iter()
            .zip(1..)
            .map(|(&(at, genre, new), id)| mutant(id, source, at, genre, new))
            .collect();
        let schema = schema(source, &mutants.iter().collect::<Vec<_>>()).expect("it is Rust");
        syn::parse_file(&schema.text).expect("it is Rust");
        let mut ids = Vec::new();
        for site in &schema.sites {
            for (id, arm) in &site.arms {
                assert!(site.whole.start <= arm.start && arm.end <= site.whole.end, "{}", schema.text);
                assert!(schema.text[arm.clone()].contains(&id.to_string()), "{}", schema.text);
                ids.push(*id);
            }
        }
        ids.sort_unstable();
        assert!(ids.iter().copied().eq(1..=mutants.len() as u32), "{ids:?}");
        schema.text
    }

    #[test]
    fn operators_within_each_other() {
        let source = "fn f(ä: i32) -> bool { /* ö */ -ä + 1 < 2 }";
        let changes = [("< 2", Genre::Binary, "=="), ("+ 1", Genre::Binary, "-"), ("-ä", Genre::Unary, "")];
        let inner = "(match ::mutant::at(2) { 2 => { (-ä) - (1) } _ => (\
                     (match ::mutant::at(3) { 3 => { ä } _ => (-ä)}) + 1)})";
        let outer = format!("(match ::mutant::at(1) {{ 1 => {{ (-ä + 1) == (2) }} _ => ({inner} < 2)}})");
        assert_eq!(text(source, &changes), format!("fn f(ä: i32) -> bool {{ /* ö */ {outer} }}"));
    }

    #[test]
    fn arms_and_their_conditions() {
        let source = "fn f(n: u8) -> u8 { match n { 0 => 1, 5 if n > 3 => 2, _ => 3 } }";
        let changes = [("0 =>", Genre::Arm, ""), ("5 if", Genre::Arm, ""), ("n > 3", Genre::Guard, "true")];
        assert_eq!(
            text(source, &changes),
            "fn f(n: u8) -> u8 { match n { 0 if (::mutant::at(1) != 1) => 1, \
             5 if (::mutant::at(1) != 2) && ((match ::mutant::at(3) { 3 => { true } _ => (n > 3)})) => 2, _ => 3 } }"
        );
    }

    #[test]
    fn values_and_fields() {
        let source = "fn f() -> A { A { a: 1, b, ..Default::default() } }";
        let changes =
            [("A { a", Genre::Value, "A::new()"), ("a: 1", Genre::Field, ""), ("b, ", Genre::Field, "")];
        assert_eq!(
            text(source, &changes),
            "fn f() -> A { match ::mutant::at(1) { 1 => { return A::new(); } _ => {} } A { \
             a: (match ::mutant::at(2) { 2 => { (Default::default()).a } _ => (1)}), \
             b: (match ::mutant::at(3) { 3 => { (Default::default()).b } _ => (b)}), ..Default::default() } }"
        );
    }

    #[test]
    fn what_binds_names_stays() {
        let source = "fn f(a: Option<u8>) -> bool { if let Some(b) = a && b > 1 { true } else { false } }";
        let mutants = [mutant(1, source, "&& b", Genre::Binary, "||")];
        let schema = schema(source, &mutants.iter().collect::<Vec<_>>()).expect("it is Rust");
        assert_eq!((&*schema.text, schema.sites.len()), (source, 0));
        let source = "fn f() -> impl Iterator<Item = u8> { [1].into_iter() }";
        let mutants = [mutant(1, source, "[1]", Genre::Value, "::std::iter::empty()")];
        let schema = super::schema(source, &mutants.iter().collect::<Vec<_>>()).expect("it is Rust");
        assert_eq!((&*schema.text, schema.sites.len()), (source, 0));
    }
}
