//! Standard input and output as a connection that outlives what is no message: it is answered by an error, as JSON-RPC
//! 2.0 has it (section 5.1), and what follows is read.

use crate::Error;
use crate::voice::Voice;
use lsp_server::{Connection, ErrorCode, Message};
use serde_json::{Value, json};
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::channel;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// A line of a header is never longer.
const LONGEST_LINE: u64 = 4096;

/// So many messages wait to be answered.
const MOST_WAITING: usize = 64;

/// The threads that read and write.
pub struct Threads {
    reader: JoinHandle<io::Result<()>>,
    writer: JoinHandle<io::Result<()>>,
}

impl Threads {
    /// Waits until all is written, and, where it ended well, until nothing more is read.
    ///
    /// # Errors
    /// The first that input or output had.
    pub fn join(self, well: bool) -> Result<(), Error> {
        let reader = well.then_some(self.reader);
        for thread in reader.into_iter().chain([self.writer]) {
            thread.join().map_err(|_| "a thread that reads or writes has died")??;
        }
        Ok(())
    }
}

/// The connection to who started the program: what it says is heard there, and it is answered by the voice.
pub fn connection() -> (Connection, Voice, Threads) {
    let (server, editor) = Connection::memory();
    let to_server = editor.sender;
    let (say, said) = channel::<String>();
    let reader = thread::spawn(move || {
        let mut input = io::stdin().lock();
        while let Some(heard) = next(&mut input)? {
            match heard {
                Ok(message) => {
                    let is_exit = matches!(&message, Message::Notification(told) if told.method == "exit");
                    // Who asks faster than is answered waits, and fills no memory.
                    while to_server.len() > MOST_WAITING {
                        thread::sleep(Duration::from_millis(1));
                    }
                    // Nobody listens any more.
                    if to_server.send(message).is_err() || is_exit {
                        break;
                    }
                }
                Err(fault) => write(&mut io::stdout().lock(), &fault.to_string())?,
            }
        }
        Ok(())
    });
    let writer = thread::spawn(move || {
        // The lock is taken for each message: the reader answers, too.
        said.into_iter().try_for_each(|body| write(&mut io::stdout().lock(), &body))
    });
    (server, Voice::new(move |body| Ok(say.send(body)?)), Threads { reader, writer })
}

/// The next message, or what is answered to something that is none; `None` at the end.
fn next(input: &mut impl BufRead) -> io::Result<Option<Result<Message, Value>>> {
    let Some(length) = header(input)? else { return Ok(None) };
    let Some(length) = length else {
        return Ok(Some(Err(fault(Value::Null, ErrorCode::ParseError, "a message begins with Content-Length: bytes"))));
    };
    // No more is kept than there is, whatever was announced.
    let mut body = Vec::new();
    if input.take(length).read_to_end(&mut body)? as u64 != length {
        return Ok(None);
    }
    let value: Value = match serde_json::from_slice(&body) {
        Ok(value) => value,
        Err(why) => return Ok(Some(Err(fault(Value::Null, ErrorCode::ParseError, &why.to_string())))),
    };
    let id = value.get("id").filter(|id| id.is_number() || id.is_string()).cloned().unwrap_or_default();
    let message = serde_json::from_value(value);
    Ok(Some(message.map_err(|_| fault(id, ErrorCode::InvalidRequest, "this is no request, notification or response"))))
}

/// Reads a header: how long the body is, `Some(None)` where it does not say; `None` at the end.
fn header(input: &mut impl BufRead) -> io::Result<Option<Option<u64>>> {
    let (mut length, mut any) = (None, false);
    loop {
        let mut line = Vec::new();
        if input.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if line.is_empty() {
            // Lines between messages are nothing.
            if any {
                return Ok(Some(length));
            }
            continue;
        }
        any = true;
        // It may stand behind what was no message.
        let name = "content-length:";
        if let Some(at) = line.to_ascii_lowercase().rfind(name) {
            length = line.get(at + name.len()..).and_then(|value| value.trim().parse().ok());
        }
    }
}

/// An error as it is answered.
fn fault(id: Value, code: ErrorCode, message: &str) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "error": { "code": code as i32, "message": message } })
}

fn write(output: &mut impl Write, body: &str) -> io::Result<()> {
    write!(output, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_message_is_answered_and_passed_over() {
        let frame = |body: &str| format!("Content-Length: {}\r\n\r\n{body}", body.len());
        let good = frame(r#"{"jsonrpc":"2.0","method":"initialized","params":{}}"#);
        let wrong = [
            (frame("{\"a\":"), -32700),
            (frame("{}"), -32600),
            (frame("[]"), -32600),
            (frame("3"), -32600),
            ("Content-Length: abc\r\n\r\n".to_owned(), -32700),
            ("Content-Length: abc\r\n\r\n{\"id\": 3}".to_owned(), -32700),
            ("Content-Length: -5\r\nX: 1\r\n\r\n".to_owned(), -32700),
            ("\r\n\nwhat is this\r\n\r\n".to_owned(), -32700),
        ];
        for (text, code) in wrong {
            let whole = format!("{text}{good}");
            let mut input = whole.as_bytes();
            let fault = next(&mut input).expect("read").expect("something").expect_err(&text);
            assert_eq!(fault["error"]["code"], code, "{text}");
            assert!(matches!(next(&mut input), Ok(Some(Ok(Message::Notification(_))))), "{text}");
            assert!(matches!(next(&mut input), Ok(None)), "{text}");
        }
        // The end within a message is the end, and nothing was taken for what was announced.
        let mut cut = &b"Content-Length: 99999999999999\r\n\r\n{"[..];
        assert!(matches!(next(&mut cut), Ok(None)));
    }
}
