//! A small HTTP server on this machine, with the faults that a test asks for.

use std::{
    collections::{BTreeMap, VecDeque},
    io::{self, BufRead, BufReader, Write},
    net::{Shutdown, SocketAddr, TcpListener, TcpStream},
    sync::{Arc, Mutex, MutexGuard},
    thread::{self, JoinHandle},
};

/// Serves until it is dropped. One connection after the other, one answer a connection.
pub(crate) struct Server {
    address: SocketAddr,
    state: Arc<Mutex<State>>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct State {
    files: BTreeMap<String, Vec<u8>>,
    etag: String,
    /// How many bytes of the body the next answers have before the connection ends.
    cuts: VecDeque<usize>,
    ignore_ranges: bool,
    ignore_conditions: bool,
    status: Option<String>,
    requests: Vec<String>,
    stop: bool,
}

/// The path and the headers of a request.
struct Request {
    path: String,
    range: Option<String>,
    condition: Option<String>,
}

impl Server {
    pub(crate) fn start() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("a bound listener has an address");
        let state = Arc::new(Mutex::new(State { etag: "\"v1\"".to_owned(), ..State::default() }));
        let shared = Arc::clone(&state);
        let thread = thread::spawn(move || {
            for stream in listener.incoming() {
                if lock(&shared).stop {
                    return;
                }
                // A client that hangs up is none of the server's business.
                let _ = stream.and_then(|stream| answer(&stream, &shared));
            }
        });
        Self { address, state, thread: Some(thread) }
    }

    pub(crate) fn address(&self) -> String {
        format!("http://{}", self.address)
    }

    pub(crate) fn put(&self, path: &str, content: &[u8]) {
        lock(&self.state).files.insert(path.to_owned(), content.to_owned());
    }

    pub(crate) fn set_etag(&self, etag: &str) {
        etag.clone_into(&mut lock(&self.state).etag);
    }

    pub(crate) fn cut_after(&self, bodies: &[usize]) {
        lock(&self.state).cuts.extend(bodies);
    }

    pub(crate) fn ignore_ranges(&self) {
        lock(&self.state).ignore_ranges = true;
    }

    pub(crate) fn ignore_conditions(&self) {
        lock(&self.state).ignore_conditions = true;
    }

    pub(crate) fn answer_with(&self, status: &str) {
        lock(&self.state).status = Some(status.to_owned());
    }

    /// The paths that were asked for, with range and condition.
    pub(crate) fn requests(&self) -> Vec<String> {
        lock(&self.state).requests.clone()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        lock(&self.state).stop = true;
        // Wakes the listener.
        drop(TcpStream::connect(self.address));
        if let Some(thread) = self.thread.take() {
            thread.join().expect("the server does not panic");
        }
    }
}

fn lock(state: &Mutex<State>) -> MutexGuard<'_, State> {
    state.lock().expect("no holder panics")
}

fn read(stream: &TcpStream) -> io::Result<Request> {
    let mut lines = BufReader::new(stream).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    let path = first.split(' ').nth(1).unwrap_or_default().to_owned();
    let mut request = Request { path, range: None, condition: None };
    for line in lines {
        let line = line?;
        match line.split_once(": ") {
            None => break,
            Some((name, value)) if name.eq_ignore_ascii_case("range") => {
                request.range = Some(value.to_owned());
            }
            Some((name, value)) if name.eq_ignore_ascii_case("if-range") => {
                request.condition = Some(value.to_owned());
            }
            Some(_) => {}
        }
    }
    Ok(request)
}

fn answer(mut stream: &TcpStream, state: &Mutex<State>) -> io::Result<()> {
    let request = read(stream)?;
    let mut state = lock(state);
    let asked = [
        Some(request.path.clone()),
        request.range.clone(),
        request.condition.as_ref().map(|tag| format!("if {tag}")),
    ];
    state.requests.push(asked.into_iter().flatten().collect::<Vec<_>>().join(" "));
    let found = state.files.get(&request.path);
    let (Some(file), None) = (found, &state.status) else {
        let status = state.status.as_deref().unwrap_or("404 Not Found");
        return write!(stream, "HTTP/1.1 {status}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    };
    let same = state.ignore_conditions || request.condition.is_none_or(|tag| tag == state.etag);
    let from = request.range.filter(|_| same && !state.ignore_ranges);
    let from = from.and_then(|range| range.strip_prefix("bytes=")?.strip_suffix('-')?.parse::<usize>().ok());
    let (length, etag) = (file.len(), &state.etag);
    let (status, range) = match from {
        Some(from) if from < length => {
            ("206 Partial Content", format!("Content-Range: bytes {from}-{}/{length}\r\n", length - 1))
        }
        Some(_) => ("416 Range Not Satisfiable", format!("Content-Range: bytes */{length}\r\n")),
        None => ("200 OK", String::new()),
    };
    let body = file[from.unwrap_or(0).min(length)..].to_vec();
    let head = format!("HTTP/1.1 {status}\r\nContent-Length: {}\r\nETag: {etag}\r\n{range}", body.len());
    write!(stream, "{head}Connection: close\r\n\r\n")?;
    let cut = state.cuts.pop_front().unwrap_or(body.len()).min(body.len());
    stream.write_all(&body[..cut])?;
    stream.shutdown(Shutdown::Write)
}
