//! The site over HTTP, for this machine alone.

use std::collections::HashMap;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;
use std::{fs, io, thread};

use tiny_http::{Header, Method, Request, Response, Server, StatusCode};

use crate::args::ServeOptions;
use crate::compress::{Coding, Effort};
use crate::failure::{Doing as _, Failure};
use crate::process::Line;
use crate::site::{self, Site};
use crate::wasm::{self, Profile};
use crate::watch::Watch;

/// Below this a compressed answer saves nothing.
const WORTH_COMPRESSING: usize = 1024;

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
    let site = Site::new(wasm::build(profile)?);
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
        match wasm::build(profile) {
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
    let server = Server::from_listener(listener, None).map_err(|error| Failure::Io {
        doing: format!("serving on {address}"),
        source: io::Error::other(error),
    })?;
    let answers = Arc::new(Answers {
        site,
        encoded: Mutex::default(),
    });
    thread::spawn(move || {
        for request in server.incoming_requests() {
            let answers = Arc::clone(&answers);
            // A thread each: a client that reads slowly holds up nobody else.
            thread::spawn(move || {
                let response = answers.answer(&request);
                // The browser went away in the middle of an answer; there is nobody left to tell.
                request.respond(response).ok();
            });
        }
    });
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

type Body = Response<io::Cursor<Vec<u8>>>;

/// What is needed to answer a request.
struct Answers {
    site: Site,
    encoded: Mutex<HashMap<(PathBuf, Coding), Encoded>>,
}

/// A compressed file, good as long as the file has not changed.
#[derive(Clone)]
struct Encoded {
    modified: SystemTime,
    bytes: Arc<Vec<u8>>,
}

impl Answers {
    fn answer(&self, request: &Request) -> Body {
        if !matches!(request.method(), Method::Get | Method::Head) {
            return plain(405, "Only GET and HEAD are answered here.").with_header(header("Allow", "GET, HEAD"));
        }
        let path = request.url().split(['?', '#']).next().unwrap_or_default();
        let Some(address) = path.strip_prefix('/').and_then(percent_decoded) else {
            return plain(400, "This address cannot be read.");
        };
        let Some(file) = self.site.locate(&address) else {
            return plain(404, "There is no such file here. The page is at /.");
        };
        match self.file(request, &address, &file) {
            Ok(response) => response,
            Err(failure) => plain(500, &failure.to_string()),
        }
    }

    fn file(&self, request: &Request, address: &str, file: &Path) -> Result<Body, Failure> {
        let metadata = fs::metadata(file).doing(format!("reading {}", file.display()))?;
        let modified = metadata
            .modified()
            .doing(format!("reading the age of {}", file.display()))?;
        let coding = field(request, "Accept-Encoding").and_then(Coding::accepted);
        let age = modified
            .duration_since(SystemTime::UNIX_EPOCH)
            .map_or(0, |age| age.as_nanos());
        let tag = format!("\"{age:x}-{:x}-{}\"", metadata.len(), coding.map_or("id", Coding::name));
        let is_page = matches!(address, "" | "index.html");
        if !is_page && field(request, "If-None-Match").is_some_and(|known| known == tag) {
            return Ok(respond(304, address, Vec::new()).with_header(header("ETag", &tag)));
        }
        let bytes = self.site.read(address, file)?;
        let coding = coding.filter(|_| bytes.len() >= WORTH_COMPRESSING);
        let response = match coding {
            None => respond(200, address, bytes),
            Some(coding) if is_page => {
                // Carries the size of the wasm, so it changes when its own file does not.
                respond(200, address, coding.encode(&bytes, Effort::Quick)).with_header(coded(coding))
            }
            Some(coding) => {
                let encoded = self.encoded(file, coding, modified, &bytes);
                respond(200, address, encoded.to_vec()).with_header(coded(coding))
            }
        };
        Ok(if is_page {
            response
        } else {
            response.with_header(header("ETag", &tag))
        })
    }

    fn encoded(&self, file: &Path, coding: Coding, modified: SystemTime, bytes: &[u8]) -> Arc<Vec<u8>> {
        let key = (file.to_owned(), coding);
        let lock = || self.encoded.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&key).filter(|known| known.modified == modified) {
            return Arc::clone(&known.bytes);
        }
        // Outside the lock: another file need not wait for this one.
        let bytes = Arc::new(coding.encode(bytes, Effort::Quick));
        lock().insert(
            key,
            Encoded {
                modified,
                bytes: Arc::clone(&bytes),
            },
        );
        bytes
    }
}

fn plain(status: u16, words: &str) -> Body {
    respond(status, "answer.txt", format!("{words}\n").into_bytes())
}

fn respond(status: u16, address: &str, bytes: Vec<u8>) -> Body {
    Response::from_data(bytes)
        .with_status_code(StatusCode(status))
        // The length is known, so it is said instead of sending chunks.
        .with_chunked_threshold(usize::MAX)
        .with_header(header("Content-Type", site::media_type(address)))
        .with_header(header("Content-Security-Policy", site::CONTENT_SECURITY_POLICY))
        .with_header(header("X-Content-Type-Options", "nosniff"))
        .with_header(header("Referrer-Policy", "no-referrer"))
        .with_header(header("Cross-Origin-Opener-Policy", "same-origin"))
        .with_header(header("Cache-Control", "no-cache"))
        .with_header(header("Vary", "Accept-Encoding"))
}

fn coded(coding: Coding) -> Header {
    header("Content-Encoding", coding.name())
}

fn header(name: &str, value: &str) -> Header {
    // Every name and value here is printable ASCII, which is all that is asked of them.
    Header::from_bytes(name, value).expect("a header of printable ASCII")
}

fn field<'a>(request: &'a Request, name: &'static str) -> Option<&'a str> {
    request
        .headers()
        .iter()
        .find(|header| header.field.equiv(name))
        .map(|header| header.value.as_str())
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
