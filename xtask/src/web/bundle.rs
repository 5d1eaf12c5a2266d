//! The page's scripts and styles, bundled by esbuild, and the head of the page that starts them.

use std::{num::NonZeroU64, path::Path};

use base64::{Engine, engine::general_purpose::STANDARD};
use sha2::{Digest, Sha256};

use super::parts::File;
use crate::{Error, ci::step};

/// The entry points of esbuild's two runs: scripts as such, and the module with the styles.
const RUNS: [(&str, &[&str]); 2] = [
    ("iife", &["start=src/start.js", "worker=src/worker.js"]),
    ("esm", &["page=src/main.js", "page=style/page.css"]),
];
/// More take longer and save less than a thousandth.
const ITERATIONS: NonZeroU64 = NonZeroU64::new(3).unwrap();
const OPTIONS: [&str; 6] = [
    "--bundle",
    "--minify",
    "--target=es2022",
    "--sourcemap=external",
    "--log-level=warning",
    // The package looks beside itself for the engines only where it is given none.
    "--log-override:empty-import-meta=silent",
];

/// Bundles the sources of a folder into another one: `start.js`, `worker.js`, `page.js` and `page.css`, each
/// with a map of its sources beside it.
pub(super) fn run(esbuild: &Path, sources: &Path, out: &Path) -> Result<(), Error> {
    for (format, entries) in RUNS {
        let mut command = std::process::Command::new(esbuild);
        command.current_dir(sources).args(entries).args(OPTIONS).arg(format!("--format={format}"));
        step(command.arg(format!("--outdir={}", out.display())), &format!("esbuild {}", entries.join(" ")))?;
    }
    Ok(())
}

/// Writes the first script and the styles into the head, where the page waits for no further file, and their
/// digests into its policy.
pub(super) fn inline(head: &str, script: &str, style: &str) -> Result<String, Error> {
    let parts = [
        ("<script src=\"start.js\"></script>", format!("<script>{script}</script>")),
        ("<link rel=\"stylesheet\" href=\"page.css\" />", format!("<style>{style}</style>")),
        ("script-src 'self'", format!("script-src 'self' '{}'", digest(script.as_bytes()))),
        ("style-src 'self'", format!("style-src 'self' '{}'", digest(style.as_bytes()))),
    ];
    parts.iter().try_fold(head.to_owned(), |head, (mark, part)| replace_once("index.html", &head, mark, part))
}

/// Puts a part in place of a mark that a file of the page must have, once.
pub(super) fn replace_once(name: &str, text: &str, mark: &str, part: &str) -> Result<String, Error> {
    match text.split_once(mark) {
        Some((before, after)) if !after.contains(mark) => Ok([before, part, after].concat()),
        _ => Err(Error::Lacking {
            what: format!("crates/web/page/{name} has no `{mark}`, or more than one"),
            mend: "the build puts something in its place".to_owned(),
        }),
    }
}

/// The digest as browsers want it.
pub(super) fn digest(bytes: &[u8]) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(bytes)))
}

/// Compresses a file by gzip, nearly as small as that format allows.
pub(super) fn packed(file: &File) -> Result<File, Error> {
    let mut bytes = Vec::new();
    let options = zopfli::Options { iteration_count: ITERATIONS, ..Default::default() };
    let done = zopfli::compress(options, zopfli::Format::Gzip, &*file.bytes, &mut bytes);
    done.map_err(Error::at(Path::new(&file.path)))?;
    Ok(File { path: format!("{}.gz", file.path), bytes })
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::{File, inline, packed, replace_once};

    const HEAD: &str = "<meta content=\"script-src 'self' blob:; style-src 'self'\">\
        <script src=\"start.js\"></script><link rel=\"stylesheet\" href=\"page.css\" />";

    #[test]
    fn the_head_holds_script_and_styles_and_allows_no_others() {
        // `printf 1 | openssl dgst -sha256 -binary | base64`
        let (one, two) = (
            "sha256-a4ayc/80/OGda4BO/1o/V0etpOqiLx1JwB5S3beHW0s=",
            "sha256-1HNeOiZeFu7gP1lxi5tdAwGcB9i2xR+Q2jpmbuwTqzU=",
        );
        let expected = format!(
            "<meta content=\"script-src 'self' '{one}' blob:; style-src 'self' '{two}'\">\
             <script>1</script><style>2</style>"
        );
        assert_eq!(inline(HEAD, "1", "2").unwrap(), expected);
        assert!(inline("<script>", "1", "2").is_err());
    }

    #[test]
    fn a_mark_is_there_once() {
        assert_eq!(replace_once("a", "1 x 2", "x", "y").unwrap(), "1 y 2");
        for text in ["", "x x"] {
            assert!(replace_once("a", text, "x", "y").unwrap_err().to_string().contains("no `x`"));
        }
    }

    #[test]
    fn what_is_packed_can_be_unpacked() {
        let file = File { path: "a.js".to_owned(), bytes: b"let a = 1;".repeat(99) };
        let packed = packed(&file).unwrap();
        assert_eq!(packed.path, "a.js.gz");
        let mut bytes = Vec::new();
        flate2::read::GzDecoder::new(&*packed.bytes).read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes, file.bytes);
        assert!(packed.bytes.len() < 100);
    }
}
