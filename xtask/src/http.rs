//! As much of HTTP/1.1 as a browser needs to fetch files from this machine: GET and HEAD over kept connections.
//!
//! A thread for each connection, so that neither a slow reader nor an idle connection that a browser keeps open holds up
//! another.

use std::io::{self, BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// No browser sends more in front of an empty line.
const HEAD_LIMIT: u64 = 64 * 1024;

/// How long a connection may be idle, and how long a reader may take none of an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// What was asked.
#[derive(Debug, Default)]
pub(crate) struct Request {
    pub(crate) method: String,
    /// The target without its query, as it was sent: with its leading slash, percent-encoded.
    pub(crate) path: String,
    fields: Vec<(String, String)>,
    /// Whether the connection is kept for another request.
    keep: bool,
}

impl Request {
    /// The value of a header field. Names are the same in any case.
    pub(crate) fn field(&self, name: &str) -> Option<&str> {
        self.fields
            .iter()
            .find(|(known, _)| known.eq_ignore_ascii_case(name))
            .map(|(_, value)| value.as_str())
    }
}

/// What is answered.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    pub(crate) status: u16,
    pub(crate) fields: Vec<(&'static str, String)>,
    pub(crate) body: Arc<[u8]>,
}

impl Response {
    /// Adds a header field.
    pub(crate) fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.fields.push((name, value.into()));
        self
    }
}

/// Answers every request in the background until the program ends.
pub(crate) fn serve(listener: TcpListener, answer: impl Fn(&Request) -> Response + Send + Sync + 'static) {
    let answer = Arc::new(answer);
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let answer = Arc::clone(&answer);
            // An error here is a browser that went away in the middle; there is nobody left to tell.
            thread::spawn(move || converse(&stream, &*answer).ok());
        }
    });
}

fn converse(stream: &TcpStream, answer: &impl Fn(&Request) -> Response) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let mut reader = BufReader::new(stream);
    while let Some(request) = read(&mut reader)? {
        let response = answer(&request);
        write(stream, &request, &response)?;
        if !request.keep {
            break;
        }
    }
    Ok(())
}

/// The next request of a connection, or `None` when it was closed between two.
fn read(reader: &mut BufReader<&TcpStream>) -> io::Result<Option<Request>> {
    let mut head = reader.take(HEAD_LIMIT);
    let mut line = String::new();
    if head.read_line(&mut line)? == 0 {
        return Ok(None);
    }
    let mut words = line.split_ascii_whitespace();
    let (Some(method), Some(target), Some(version)) = (words.next(), words.next(), words.next()) else {
        return Err(malformed("a request line"));
    };
    let path = target.split(['?', '#']).next().unwrap_or_default();
    let mut request = Request {
        method: method.to_owned(),
        path: path.to_owned(),
        ..Request::default()
    };
    let keeps_by_itself = version == "HTTP/1.1";
    loop {
        line.clear();
        if head.read_line(&mut line)? == 0 {
            return Err(malformed("an empty line after the header"));
        }
        let field = line.trim_end();
        if field.is_empty() {
            break;
        }
        let (name, value) = field.split_once(':').ok_or_else(|| malformed("a header field"))?;
        request.fields.push((name.to_owned(), value.trim().to_owned()));
    }
    let says = |word: &str| {
        request
            .field("Connection")
            .is_some_and(|value| value.to_ascii_lowercase().contains(word))
    };
    // Bodies are not read, so after one the connection cannot go on.
    let has_body = request.field("Transfer-Encoding").is_some()
        || request
            .field("Content-Length")
            .is_some_and(|length| length.trim() != "0");
    request.keep = !has_body && !says("close") && (keeps_by_itself || says("keep-alive"));
    Ok(Some(request))
}

fn write(mut stream: &TcpStream, request: &Request, response: &Response) -> io::Result<()> {
    let mut out = format!("HTTP/1.1 {} {}\r\n", response.status, reason(response.status));
    for (name, value) in &response.fields {
        out.push_str(&format!("{name}: {value}\r\n"));
    }
    let connection = if request.keep { "keep-alive" } else { "close" };
    // 304 is about a body that is not sent; its length would be wrong here.
    if response.status != 304 {
        out.push_str(&format!("Content-Length: {}\r\n", response.body.len()));
    }
    out.push_str(&format!("Connection: {connection}\r\n\r\n"));
    stream.write_all(out.as_bytes())?;
    if request.method != "HEAD" && response.status != 304 {
        stream.write_all(&response.body)?;
    }
    stream.flush()
}

fn malformed(expected: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("expected {expected}"))
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        304 => "Not Modified",
        400 => "Bad Request",
        404 => "Not Found",
        405 => "Method Not Allowed",
        _ => "Internal Server Error",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::SocketAddr;

    fn start() -> SocketAddr {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("its address");
        serve(listener, |request| Response {
            status: if request.path == "/gone" { 404 } else { 200 },
            fields: vec![("X-Asked", request.field("x-ask").unwrap_or("nothing").to_owned())],
            body: Arc::from(format!("{} {}", request.method, request.path).into_bytes()),
        });
        address
    }

    fn talk(stream: &mut TcpStream, text: &str, answers: &[&str]) {
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .expect("a timeout");
        stream.write_all(text.as_bytes()).expect("sending");
        let expected = answers.concat();
        let mut found = vec![0; expected.len()];
        stream.read_exact(&mut found).expect("an answer");
        assert_eq!(String::from_utf8_lossy(&found), expected);
    }

    const KEPT: &str = "HTTP/1.1 200 OK\r\nX-Asked: nothing\r\nContent-Length: 6\r\nConnection: keep-alive\r\n\r\n";

    #[test]
    fn requests_follow_each_other_on_one_connection() {
        let mut stream = TcpStream::connect(start()).expect("connecting");
        talk(&mut stream, "GET /a?q HTTP/1.1\r\n\r\n", &[KEPT, "GET /a"]);
        talk(&mut stream, "HEAD /a HTTP/1.1\r\n\r\n", &[&KEPT.replace(": 6", ": 7")]);
        let closing =
            "HTTP/1.1 404 Not Found\r\nX-Asked: yes\r\nContent-Length: 9\r\nConnection: close\r\n\r\nGET /gone";
        talk(
            &mut stream,
            "GET /gone HTTP/1.1\r\nX-Ask:  yes \r\nConnection: Close\r\n\r\n",
            &[closing],
        );
        assert_eq!(stream.read(&mut [0]).expect("the end"), 0);
    }

    #[test]
    fn idle_connections_hold_up_nobody() {
        let address = start();
        let idle: Vec<TcpStream> = (0..32)
            .map(|_| TcpStream::connect(address).expect("connecting"))
            .collect();
        let mut slow = TcpStream::connect(address).expect("connecting");
        slow.write_all(b"GET /never-ended HTTP/1.1\r\n").expect("sending");
        for _ in 0..16 {
            let mut stream = TcpStream::connect(address).expect("connecting");
            talk(&mut stream, "GET /a HTTP/1.1\r\n\r\n", &[KEPT, "GET /a"]);
        }
        drop(idle);
    }

    #[test]
    fn what_is_not_http_ends_the_connection() {
        for text in [
            "hello\r\n\r\n".to_owned(),
            format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(HEAD_LIMIT as usize)),
        ] {
            let mut stream = TcpStream::connect(start()).expect("connecting");
            stream
                .set_read_timeout(Some(Duration::from_secs(10)))
                .expect("a timeout");
            stream.write_all(text.as_bytes()).expect("sending");
            // A reset is an end too: the rest of what was sent was never read.
            assert!(!matches!(stream.read(&mut [0]), Ok(1)), "{} bytes", text.len());
        }
    }
}
