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
use crate::http::{self, Request, Response};
use crate::process::Line;
use crate::site::{self, Site};
use crate::wasm::{self, Profile};
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
            // It carries the size of the wasm, so it changes when its own file does not: made anew each time.
            let bytes = self.site.read(address, file)?;
            return Ok(match coding {
                None => respond(200, address, bytes.into()),
                Some(coding) => {
                    let encoded = coding.encode(&bytes, Effort::Quick);
                    respond(200, address, encoded.into()).with("Content-Encoding", coding.name())
                }
            });
        }
        let metadata = fs::metadata(file).doing(format!("reading {}", file.display()))?;
        let modified = metadata
            .modified()
            .doing(format!("reading the age of {}", file.display()))?;
        let coding = coding.filter(|_| metadata.len() >= WORTH_COMPRESSING);
        let age = modified
            .duration_since(SystemTime::UNIX_EPOCH)
            .map_or(0, |age| age.as_nanos());
        let tag = format!("\"{age:x}-{:x}-{}\"", metadata.len(), coding.map_or("id", Coding::name));
        if request.field("If-None-Match").is_some_and(|known| known == tag) {
            return Ok(respond(304, address, Arc::default()).with("ETag", tag));
        }
        let response = match coding {
            None => respond(200, address, self.site.read(address, file)?.into()),
            Some(coding) => {
                let encoded = self.encoded(address, file, coding, modified)?;
                respond(200, address, encoded).with("Content-Encoding", coding.name())
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
    respond(status, "answer.txt", format!("{words}\n").into_bytes().into())
}

fn respond(status: u16, address: &str, body: Arc<[u8]>) -> Response {
    Response {
        status,
        fields: Vec::new(),
        body,
    }
    .with("Content-Type", site::media_type(address))
    .with("Content-Security-Policy", site::CONTENT_SECURITY_POLICY)
    .with("X-Content-Type-Options", "nosniff")
    .with("Referrer-Policy", "no-referrer")
    .with("Cross-Origin-Opener-Policy", "same-origin")
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
