//! The site over HTTP, for this machine alone.

use std::collections::HashMap;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;
use std::{fs, io, thread};

use crate::args::ServeOptions;
use crate::compress::{Coding, Effort};
use crate::failure::{Doing as _, Failure};
use crate::http::{self, Body, Request, Response};
use crate::process::Line;
use crate::site::{self, Site};
use crate::wasm::{self, Profile, Program};
use crate::watch::Watch;

/// Below this a compressed answer saves nothing.
const WORTH_COMPRESSING: u64 = 1024;

/// `cargo xtask serve`.
pub(crate) fn run(options: &ServeOptions) -> Result<(), Failure> {
    // Bind the port first: nobody wants to build for minutes and then hear that it is taken.
    let listener = listen(options.port)?;
    let profile = if options.release {
        Profile::Release
    } else {
        Profile::Dev
    };
    let mut watch = Watch::new();
    // The full program at both addresses: one build shows a change on either way to draw.
    let programs: &[Program] = if options.examples {
        &[Program::Full, Program::Element]
    } else {
        &[Program::Full]
    };
    let build = || {
        let built = programs
            .iter()
            .map(|&program| Ok((program, wasm::build(profile, program)?)));
        built.collect::<Result<Vec<_>, Failure>>()
    };
    let site = Site::new(build()?);
    let address = start(listener, site)?;
    let page = format!("http://{address}/");
    println!("\n  Bindpose is at {page}\n  Drop a .m3d on the page. Ctrl+C ends it.\n");
    if options.open {
        open(&page);
    }
    loop {
        if !options.watch {
            thread::park();
            continue;
        }
        watch.wait();
        match build() {
            Ok(_) => println!("  built; reload {page}"),
            Err(failure) => eprintln!("{failure}"),
        }
    }
}

/// Takes a port on the loopback address. 0 takes any free one.
pub(crate) fn listen(port: u16) -> Result<TcpListener, Failure> {
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    TcpListener::bind(address).map_err(|source| match source.kind() {
        io::ErrorKind::AddrInUse => Failure::Remedy {
            what: format!("port {port} is taken by another program, so the page cannot be served there"),
            remedy: format!("cargo xtask serve --port {}", port.checked_add(1).unwrap_or(0)),
        },
        _ => Failure::Io {
            doing: format!("listening on {address}"),
            source,
        },
    })
}

/// Serves in the background until the program ends.
pub(crate) fn start(listener: TcpListener, site: Site) -> Result<SocketAddr, Failure> {
    let address = listener.local_addr().doing("reading the port")?;
    let answers = Answers {
        site,
        encoded: Mutex::default(),
    };
    http::serve(listener, move |request| answers.answer(request));
    Ok(address)
}

fn open(page: &str) {
    let line = if cfg!(target_os = "macos") {
        Line::new("open").args([page])
    } else if cfg!(windows) {
        Line::new("cmd").args(["/C", "start", "", page])
    } else {
        Line::new("xdg-open").args([page])
    };
    if line.run().is_err() {
        eprintln!("  no browser could be opened; go to {page} by hand");
    }
}

/// What is needed to answer a request.
struct Answers {
    site: Site,
    encoded: Mutex<HashMap<(PathBuf, Coding), Encoded>>,
}

/// A compressed file, good as long as the file has not changed.
#[derive(Clone)]
struct Encoded {
    modified: SystemTime,
    bytes: Arc<[u8]>,
}

impl Answers {
    fn answer(&self, request: &Request) -> Response {
        if !matches!(request.method.as_str(), "GET" | "HEAD") {
            return plain(405, "Only GET and HEAD are answered here.").with("Allow", "GET, HEAD");
        }
        let Some(address) = request.path.strip_prefix('/').and_then(percent_decoded) else {
            return plain(400, "This address cannot be read.");
        };
        let Some(file) = self.site.locate(&address) else {
            return plain(404, "There is no such file here. The page is at /.");
        };
        self.file(request, &address, &file)
            .unwrap_or_else(|failure| plain(500, &failure.to_string()))
    }

    fn file(&self, request: &Request, address: &str, file: &Path) -> Result<Response, Failure> {
        let coding = request.field("Accept-Encoding").and_then(Coding::accepted);
        if matches!(address, "" | "index.html") {
            // It carries the sizes of the programs, so it changes when its own file does not: made anew each time.
            let bytes = self.site.read(address, file)?;
            return Ok(match coding {
                None => respond(200, address, Body::Bytes(bytes.into())),
                Some(coding) => {
                    let encoded = coding.encode(&bytes, Effort::Quick);
                    respond(200, address, Body::Bytes(encoded.into())).with("Content-Encoding", coding.name())
                }
            });
        }
        let metadata = fs::metadata(file).doing(format!("reading {}", file.display()))?;
        let modified = metadata
            .modified()
            .doing(format!("reading the age of {}", file.display()))?;
        // Nothing is read or compressed for the header alone.
        let coding = coding.filter(|_| metadata.len() >= WORTH_COMPRESSING && request.method != "HEAD");
        let age = modified
            .duration_since(SystemTime::UNIX_EPOCH)
            .map_or(0, |age| age.as_nanos());
        let tag = format!("\"{age:x}-{:x}-{}\"", metadata.len(), coding.map_or("id", Coding::name));
        if request.field("If-None-Match").is_some_and(|known| known == tag) {
            return Ok(respond(304, address, Body::Bytes(Arc::default())).with("ETag", tag));
        }
        let response = match coding {
            None => {
                let opened = fs::File::open(file).doing(format!("reading {}", file.display()))?;
                respond(200, address, Body::File(opened, metadata.len()))
            }
            Some(coding) => {
                let encoded = self.encoded(address, file, coding, modified)?;
                respond(200, address, Body::Bytes(encoded)).with("Content-Encoding", coding.name())
            }
        };
        Ok(response.with("ETag", tag))
    }

    fn encoded(&self, address: &str, file: &Path, coding: Coding, modified: SystemTime) -> Result<Arc<[u8]>, Failure> {
        let key = (file.to_owned(), coding);
        let lock = || self.encoded.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&key).filter(|known| known.modified == modified) {
            return Ok(Arc::clone(&known.bytes));
        }
        // Outside the lock: another file need not wait for this one.
        let bytes: Arc<[u8]> = coding.encode(&self.site.read(address, file)?, Effort::Quick).into();
        lock().insert(
            key,
            Encoded {
                modified,
                bytes: Arc::clone(&bytes),
            },
        );
        Ok(bytes)
    }
}

fn plain(status: u16, words: &str) -> Response {
    respond(
        status,
        "answer.txt",
        Body::Bytes(format!("{words}\n").into_bytes().into()),
    )
}

fn respond(status: u16, address: &str, body: Body) -> Response {
    Response {
        status,
        fields: Vec::new(),
        body,
    }
    .with("Content-Type", site::media_type(address))
    .with(
        "Content-Security-Policy",
        format!("{}; {}", site::CONTENT_SECURITY_POLICY, site::FRAME_ANCESTORS),
    )
    .with("X-Content-Type-Options", "nosniff")
    .with("Referrer-Policy", "no-referrer")
    .with("Cache-Control", "no-cache")
    .with("Vary", "Accept-Encoding")
}

/// The text behind `%xx`, or `None` when it is malformed or not UTF-8.
fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => {
                let digits = [rest.next()?, rest.next()?];
                let digit = |byte: u8| char::from(byte).to_digit(16);
                u8::try_from(digit(digits[0])? * 16 + digit(digits[1])?).ok()?
            }
            byte => byte,
        });
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read as _, Write as _};
    use std::net::TcpStream;

    /// The header of an answer, and what comes after it.
    fn asked(address: SocketAddr, request: &str) -> (String, Vec<u8>) {
        let mut stream = TcpStream::connect(address).expect("connecting");
        let text = format!("{request} HTTP/1.1\r\nConnection: close\r\n\r\n");
        stream.write_all(text.as_bytes()).expect("sending");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer");
        let end = answer
            .windows(4)
            .position(|bytes| bytes == b"\r\n\r\n")
            .expect("a header")
            + 4;
        let body = answer.split_off(end);
        (String::from_utf8(answer).expect("text"), body)
    }

    #[test]
    fn a_file_is_sent_as_it_is_and_a_header_alone_has_its_length() {
        // No wasm is needed to look at the page, so any folder will do for it.
        let site = Site::new([(Program::Full, crate::root().join("web"))]);
        let address = start(listen(0).expect("a port"), site).expect("it serves");
        let file = fs::read(crate::root().join("web/sample/figure.m3d")).expect("the sample");
        let (got, sent) = asked(address, "GET /web/sample/figure.m3d");
        assert!(got.starts_with("HTTP/1.1 200 OK\r\n") && sent == file, "{got}");
        let (head, nothing) = asked(address, "HEAD /web/sample/figure.m3d");
        assert!(nothing.is_empty());
        assert!(head.contains(&format!("Content-Length: {}\r\n", file.len())), "{head}");
        assert!(head.contains("; form-action 'none'; frame-ancestors *\r\n"), "{head}");
        assert!(asked(address, "GET /web/../Cargo.toml").0.starts_with("HTTP/1.1 404 "));
    }
}
