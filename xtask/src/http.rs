//! As much of HTTP/1.1 as a browser needs to fetch files from this machine: GET and HEAD over kept connections.
//!
//! A thread for each connection, so that neither a slow reader nor an idle connection that a browser keeps open holds up
//! another.

use std::fs::File;
use std::io::{self, BufRead as _, BufReader, Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// No browser sends more in front of an empty line.
const HEAD_LIMIT: u64 = 64 * 1024;

/// How long a connection may be idle, and how long a reader may take none of an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// Connections at a time. A browser opens six to a host.
const MOST_CONNECTIONS: usize = 512;

/// How long it may be quiet after a refusal, and how much is read of what comes.
const LAST_PATIENCE: Duration = Duration::from_secs(2);
const LAST_BYTES: u64 = 1 << 20;

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
#[derive(Debug)]
pub(crate) struct Response {
    pub(crate) status: u16,
    pub(crate) fields: Vec<(&'static str, String)>,
    pub(crate) body: Body,
}

/// What is sent after the header.
#[derive(Debug)]
pub(crate) enum Body {
    /// Bytes that several answers may share.
    Bytes(Arc<[u8]>),
    /// So many bytes of a file, read while they are sent.
    File(File, u64),
}

impl Body {
    fn length(&self) -> u64 {
        match self {
            Self::Bytes(bytes) => bytes.len() as u64,
            Self::File(_, length) => *length,
        }
    }
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
    // As many as there are connections, and this one.
    let seats = Arc::new(());
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            if Arc::strong_count(&seats) > MOST_CONNECTIONS {
                // An error here and below is a browser that went away in the middle; there is nobody left to tell.
                let _ = refuse(&stream, 503, Duration::from_millis(50));
                continue;
            }
            let (answer, seat) = (Arc::clone(&answer), Arc::clone(&seats));
            thread::spawn(move || {
                let _ = converse(&stream, &*answer);
                drop(seat);
            });
        }
    });
}

/// Answers what cannot be answered, and ends the connection.
fn refuse(mut stream: &TcpStream, status: u16, patience: Duration) -> io::Result<()> {
    let response = Response {
        status,
        fields: vec![("Content-Type", "text/plain; charset=utf-8".to_owned())],
        body: Body::Bytes(format!("{}\n", reason(status)).into_bytes().into()),
    };
    write(stream, &Request::default(), &response)?;
    stream.shutdown(Shutdown::Write)?;
    stream.set_read_timeout(Some(patience))?;
    // What was sent and never read would take the answer away.
    let mut left = LAST_BYTES;
    let mut unread = [0; 4096];
    while left > 0 {
        match stream.read(&mut unread)? {
            0 => break,
            length => left = left.saturating_sub(length as u64),
        }
    }
    Ok(())
}

fn converse(stream: &TcpStream, answer: &impl Fn(&Request) -> Response) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let mut reader = BufReader::new(stream);
    loop {
        let request = match read(&mut reader)? {
            Next::Request(request) => request,
            Next::End => return Ok(()),
            Next::Refused(status) => return refuse(stream, status, LAST_PATIENCE),
        };
        write(stream, &request, &answer(&request))?;
        if !request.keep {
            return Ok(());
        }
    }
}

/// What comes next on a connection.
enum Next {
    Request(Request),
    /// It was closed.
    End,
    /// What came is no request; this status says why.
    Refused(u16),
}

fn read(reader: &mut BufReader<&TcpStream>) -> io::Result<Next> {
    let mut head = reader.take(HEAD_LIMIT);
    let next = read_head(&mut head);
    match next {
        _ if head.limit() == 0 => Ok(Next::Refused(431)),
        Err(error) if error.kind() == io::ErrorKind::InvalidData => Ok(Next::Refused(400)),
        next => next,
    }
}

/// # Errors
/// `InvalidData` where it is no request.
fn read_head(head: &mut io::Take<&mut BufReader<&TcpStream>>) -> io::Result<Next> {
    let mut line = String::new();
    if head.read_line(&mut line)? == 0 {
        return Ok(Next::End);
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
            return Ok(Next::End);
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
    Ok(Next::Request(request))
}

fn write(mut stream: &TcpStream, request: &Request, response: &Response) -> io::Result<()> {
    let mut out = format!("HTTP/1.1 {} {}\r\n", response.status, reason(response.status));
    for (name, value) in &response.fields {
        out.push_str(&format!("{name}: {value}\r\n"));
    }
    let connection = if request.keep { "keep-alive" } else { "close" };
    // 304 is about a body that is not sent; its length would be wrong here.
    if response.status != 304 {
        out.push_str(&format!("Content-Length: {}\r\n", response.body.length()));
    }
    out.push_str(&format!("Connection: {connection}\r\n\r\n"));
    stream.write_all(out.as_bytes())?;
    if request.method != "HEAD" && response.status != 304 {
        match &response.body {
            Body::Bytes(bytes) => stream.write_all(bytes)?,
            // A file that became shorter meanwhile ends the connection.
            Body::File(file, length) if io::copy(&mut file.take(*length), &mut stream)? < *length => {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            Body::File(..) => {}
        }
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
        431 => "Request Header Fields Too Large",
        503 => "Service Unavailable",
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
            body: Body::Bytes(Arc::from(format!("{} {}", request.method, request.path).into_bytes())),
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
    fn what_is_not_http_is_told_so_and_ends_the_connection() {
        let long = "a".repeat(2 * HEAD_LIMIT as usize);
        for (text, status) in [
            (b"hello\r\n\r\n".to_vec(), "400 Bad Request"),
            (b"GET /a HTTP/1.1\r\nno colon\r\n\r\n".to_vec(), "400 Bad Request"),
            (b"GET /\xff HTTP/1.1\r\n\r\n".to_vec(), "400 Bad Request"),
            (
                format!("GET /{long} HTTP/1.1\r\n\r\n").into_bytes(),
                "431 Request Header Fields Too Large",
            ),
            (
                format!("GET /a HTTP/1.1\r\nX-Ask: {long}\r\n\r\n").into_bytes(),
                "431 Request Header Fields Too Large",
            ),
        ] {
            let answer = answer_to(start(), &text);
            assert!(answer.starts_with(&format!("HTTP/1.1 {status}\r\n")), "{answer}");
            assert!(answer.contains("Connection: close\r\n"), "{answer}");
        }
    }

    /// All that comes back until the connection ends.
    fn answer_to(address: SocketAddr, text: &[u8]) -> String {
        let mut stream = TcpStream::connect(address).expect("connecting");
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .expect("a timeout");
        stream.write_all(text).expect("sending");
        stream.shutdown(Shutdown::Write).expect("the end");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }

    #[test]
    fn more_connections_than_there_are_seats_are_refused_until_one_ends() {
        let address = start();
        let mut idle: Vec<TcpStream> = (0..MOST_CONNECTIONS)
            .map(|_| TcpStream::connect(address).expect("connecting"))
            .collect();
        let ask = || answer_to(address, b"GET /a HTTP/1.1\r\nConnection: close\r\n\r\n");
        assert!(ask().starts_with("HTTP/1.1 503 "));
        idle.truncate(8);
        let served = (0..100).any(|_| {
            thread::sleep(Duration::from_millis(20));
            ask().starts_with("HTTP/1.1 200 ")
        });
        assert!(served);
    }
}
