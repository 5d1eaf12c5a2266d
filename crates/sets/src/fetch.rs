//! Downloads that can be resumed.

use std::{
    fs::{self, File, OpenOptions},
    io::{Read, Write},
    net::IpAddr,
    path::{Path, PathBuf},
    time::Duration,
};

use indicatif::{ProgressBar, ProgressStyle};
use ureq::{Agent, Body, http::Response};

use crate::Error;

/// Where archives come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// The public addresses of the manifest.
    Site,
    /// A folder with files of the same names.
    Folder(PathBuf),
    /// An address below which there are files of the same names.
    Url(String),
}

impl Source {
    /// The source that `--mirror` names.
    #[must_use]
    pub fn from_mirror(mirror: Option<&str>) -> Self {
        match mirror {
            None | Some("") => Self::Site,
            Some(url) if url.starts_with("http://") || url.starts_with("https://") => {
                Self::Url(url.trim_end_matches('/').to_owned())
            }
            Some(folder) => Self::Folder(PathBuf::from(folder.strip_prefix("file://").unwrap_or(folder))),
        }
    }

    /// The archive of this name on disk; downloaded to `folder` unless the source is a folder itself. `url`
    /// is the public address.
    pub(crate) fn fetch(&self, name: &str, url: &str, folder: &Path) -> Result<PathBuf, Error> {
        match self {
            Self::Folder(mirror) => {
                let path = mirror.join(name);
                if path.is_file() {
                    Ok(path)
                } else {
                    Err(Error::Absent { place: path.display().to_string() })
                }
            }
            Self::Site => Download::new(url, folder.join(name)).run(),
            Self::Url(base) => Download::new(&format!("{base}/{name}"), folder.join(name)).run(),
        }
    }
}

/// How many times a download is attempted in one run if the connection is cut.
const ATTEMPTS: usize = 3;

/// One file. While it is incomplete its bytes are in `NAME.part`; `NAME.part.of` says of which file they are
/// the beginning, and is written before them.
struct Download {
    url: String,
    target: PathBuf,
    part: PathBuf,
    part_of: PathBuf,
}

/// A version of a file on the server.
#[derive(Clone, PartialEq, Eq)]
struct Version {
    length: u64,
    /// Empty where the server gives none, or one that may name several versions.
    etag: String,
}

impl Download {
    fn new(url: &str, target: PathBuf) -> Self {
        let with = |ending: &str| {
            let mut name = target.clone().into_os_string();
            name.push(ending);
            PathBuf::from(name)
        };
        Self { url: url.to_owned(), part: with(".part"), part_of: with(".part.of"), target }
    }

    fn run(&self) -> Result<PathBuf, Error> {
        if self.target.is_file() {
            return Ok(self.target.clone());
        }
        let folder = self.target.parent().unwrap_or(Path::new(""));
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
        let agent = agent(&self.url);
        let mut attempt = 1;
        loop {
            match self.attempt(&agent) {
                Err(Error::Cut { .. }) if attempt < ATTEMPTS => attempt += 1,
                done => return done.map(|()| self.target.clone()),
            }
        }
    }

    /// One request for what is missing.
    fn attempt(&self, agent: &Agent) -> Result<(), Error> {
        let (have, version) = self.state();
        let known = version.filter(|_| have > 0);
        let mut response = self.request(agent, known.as_ref().map(|version| (have, &*version.etag)))?;
        let resumed =
            response.status() == 206 && known.as_ref().is_some_and(|known| continues(&response, have, known));
        if !resumed && matches!(response.status().as_u16(), 206 | 416) {
            // The rest of another version, or the server has nothing after the bytes on disk.
            response = self.request(agent, None)?;
        }
        match response.status().as_u16() {
            206 if resumed => {}
            200 => self.begin(&response)?,
            404 | 410 => return Err(Error::Absent { place: self.url.clone() }),
            status => return Err(Error::Status { url: self.url.clone(), status }),
        }
        self.receive(response)?;
        fs::rename(&self.part, &self.target).map_err(Error::at(&self.target))?;
        remove(&self.part_of)
    }

    /// The number of bytes on disk, and the version of the file that they belong to.
    fn state(&self) -> (u64, Option<Version>) {
        let text = fs::read_to_string(&self.part_of).unwrap_or_default();
        let version = text.split_once('\n').and_then(|(length, etag)| {
            Some(Version { length: length.parse().ok()?, etag: etag.trim_end().to_owned() })
        });
        (fs::metadata(&self.part).map_or(0, |about| about.len()), version)
    }

    fn request(&self, agent: &Agent, rest: Option<(u64, &str)>) -> Result<Response<Body>, Error> {
        let mut request = agent.get(&self.url);
        if let Some((from, etag)) = rest {
            request = request.header("Range", format!("bytes={from}-"));
            if !etag.is_empty() {
                request = request.header("If-Range", etag);
            }
        }
        request.call().map_err(|source| Error::Network { url: self.url.clone(), source: Box::new(source) })
    }

    /// Discards the bytes on disk, and notes the version that is to come.
    fn begin(&self, response: &Response<Body>) -> Result<(), Error> {
        remove(&self.part_of)?;
        File::create(&self.part).map_err(Error::at(&self.part))?;
        let Some(length) = response.body().content_length() else { return Ok(()) };
        let version = format!("{length}\n{}\n", etag(response));
        fs::write(&self.part_of, version).map_err(Error::at(&self.part_of))
    }

    /// Appends the body, and makes sure that the file is then complete.
    fn receive(&self, response: Response<Body>) -> Result<(), Error> {
        let (mut have, version) = self.state();
        let expected = version.map(|version| version.length);
        let bar = progress(&self.target, have, expected);
        let mut file = OpenOptions::new().append(true).open(&self.part).map_err(Error::at(&self.part))?;
        let mut body = response.into_body().into_reader();
        let mut buffer = vec![0; 1 << 16];
        let ended = loop {
            match body.read(&mut buffer) {
                Ok(0) => break expected.is_none_or(|expected| have == expected),
                Ok(count) => {
                    file.write_all(&buffer[..count]).map_err(Error::at(&self.part))?;
                    have += count as u64;
                    bar.set_position(have);
                }
                Err(_) => break false,
            }
        };
        bar.finish_and_clear();
        if ended {
            return Ok(());
        }
        let expected = expected.map_or("?".to_owned(), |expected| expected.to_string());
        Err(Error::Cut { url: self.url.clone(), found: have, expected })
    }
}

/// Whether a partial answer begins where the bytes on disk end, in the same version of the file.
fn continues(response: &Response<Body>, have: u64, known: &Version) -> bool {
    let range = response.headers().get("content-range").and_then(|value| value.to_str().ok());
    let range = range.and_then(|range| range.strip_prefix("bytes ")?.split_once('/'));
    let Some((span, length)) = range else { return false };
    let from = span.split('-').next().and_then(|from| from.parse::<u64>().ok());
    from == Some(have) && length.parse() == Ok(known.length) && etag(response) == known.etag
}

/// The entity tag, if it is a strong one: only such a tag stands for the same bytes (RFC 9110, section
/// 8.8.1).
fn etag(response: &Response<Body>) -> String {
    let tag = response.headers().get("etag").and_then(|value| value.to_str().ok());
    tag.filter(|tag| tag.starts_with('"')).unwrap_or_default().to_owned()
}

fn remove(path: &Path) -> Result<(), Error> {
    if path.exists() { fs::remove_file(path).map_err(Error::at(path)) } else { Ok(()) }
}

fn agent(url: &str) -> Agent {
    let patience = Some(Duration::from_secs(60));
    let mut config = Agent::config_builder()
        .user_agent("mediant-xtask")
        .http_status_as_error(false)
        .timeout_connect(Some(Duration::from_secs(20)))
        .timeout_recv_response(patience)
        .timeout_per_read(patience);
    // A proxy cannot reach this machine's own addresses.
    if is_loopback(url) {
        config = config.proxy(None);
    }
    config.build().into()
}

fn is_loopback(url: &str) -> bool {
    let host = url.split("://").nth(1).and_then(|rest| rest.split(['/', ':']).next()).unwrap_or_default();
    host == "localhost" || host.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
}

/// A bar on stderr; invisible where that is no terminal.
fn progress(target: &Path, have: u64, length: Option<u64>) -> ProgressBar {
    let bar = length.map_or_else(ProgressBar::no_length, ProgressBar::new);
    let style = ProgressStyle::with_template("{msg:22} {wide_bar} {bytes:>10} / {total_bytes:<10} {eta:>4}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(target.file_name().unwrap_or_default().to_string_lossy().into_owned());
    bar.with_position(have)
}
