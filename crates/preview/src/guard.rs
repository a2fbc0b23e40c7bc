//! Who is let in. A page of another site can send requests to this computer, and can give its own name this
//! computer's address; another person on this computer can open the port. So a request must name the address that the
//! preview has, must not come from another site's page, and must know the token in the address that only the person
//! at the terminal was shown.

use axum::http::{HeaderMap, header};
use std::fmt::Write;
use std::net::IpAddr;

/// Bytes of the token: more than can be guessed.
const BYTES: usize = 16;

/// What a request must have.
#[derive(Clone, Debug)]
pub struct Guard {
    token: String,
    address: IpAddr,
}

impl Guard {
    /// With a new token.
    ///
    /// # Errors
    /// When the system gives no random numbers.
    pub fn new(address: IpAddr) -> Result<Self, getrandom::Error> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)?;
        let mut token = String::new();
        for byte in bytes {
            // A string takes what it is given.
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Guard { token, address })
    }

    pub fn token(&self) -> &str {
        &self.token
    }

    /// The rest of a path that begins with the token.
    pub fn behind_token<'p>(&self, path: &'p str) -> Option<&'p str> {
        let path = path.strip_prefix('/')?;
        let (token, rest) = path.split_once('/')?;
        self.is_token(token).then_some(rest)
    }

    /// Whether a path is the page's, but for its last slash.
    pub fn lacks_slash(&self, path: &str) -> bool {
        path.strip_prefix('/').is_some_and(|token| self.is_token(token))
    }

    /// In a time that tells nothing of how much of it is right.
    fn is_token(&self, token: &str) -> bool {
        let differs = token.bytes().zip(self.token.bytes()).fold(0, |differs, (a, b)| differs | (a ^ b));
        token.len() == self.token.len() && differs == 0
    }

    /// Whether a request comes from a page of ours, or from no page.
    pub fn lets_in(&self, headers: &HeaderMap) -> bool {
        let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or("?"));
        let Some(host) = text(header::HOST) else { return false };
        // Several of them are a trick.
        let once = headers.get_all(header::HOST).iter().count() == 1;
        let origin = text(header::ORIGIN).is_none_or(|origin| origin.strip_prefix("http://") == Some(host));
        let site = headers.get("sec-fetch-site").and_then(|site| site.to_str().ok());
        let site = site.is_none_or(|site| matches!(site, "same-origin" | "none"));
        once && origin && site && self.is_ours(host)
    }

    /// Whether a `Host` is this computer's: a name that another site may have made point here is not. The port may be
    /// another one, as it is where ssh forwards it.
    fn is_ours(&self, host: &str) -> bool {
        let Some(name) = without_port(host) else { return false };
        if name.eq_ignore_ascii_case("localhost") {
            return true;
        }
        let Ok(address) = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>() else { return false };
        address.is_loopback() || address == self.address || self.address.is_unspecified()
    }
}

/// `localhost` of `localhost:80`, `[::1]` of `[::1]:80`.
fn without_port(host: &str) -> Option<&str> {
    let end = if host.starts_with('[') { host.find(']')? + 1 } else { host.find(':').unwrap_or(host.len()) };
    let port = &host[end..];
    let is_port = |port: &str| !port.is_empty() && port.bytes().all(|byte| byte.is_ascii_digit());
    (port.is_empty() || port.strip_prefix(':').is_some_and(is_port)).then_some(&host[..end])
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn guard(address: &str) -> Guard {
        Guard::new(address.parse().expect("an address")).expect("random numbers")
    }

    #[test]
    fn names_of_other_sites_are_not_let_in() {
        let loopback = guard("127.0.0.1");
        let lets_in = |guard: &Guard, pairs: &[(&'static str, &str)]| {
            let mut headers = HeaderMap::new();
            for (name, value) in pairs {
                headers.append(*name, HeaderValue::from_str(value).expect("a header"));
            }
            guard.lets_in(&headers)
        };
        for host in ["127.0.0.1:4000", "localhost:4000", "LOCALHOST", "[::1]:4000", "127.1.2.3:1"] {
            assert!(lets_in(&loopback, &[("host", host)]), "{host}");
            let origin = format!("http://{host}");
            assert!(lets_in(&loopback, &[("host", host), ("origin", &origin), ("sec-fetch-site", "same-origin")]));
        }
        for host in [
            "evil.example:4000",
            "127.0.0.1.evil.example",
            "localhost.evil.example",
            "10.0.0.1:4000",
            "",
            "[::1",
            "localhost:x",
            "localhost:",
        ] {
            assert!(!lets_in(&loopback, &[("host", host)]), "{host}");
        }
        assert!(!lets_in(&loopback, &[]));
        assert!(!lets_in(&loopback, &[("host", "localhost:1"), ("host", "localhost:1")]));
        for origin in ["http://evil.example", "null", "https://localhost:4000", "http://localhost:4001"] {
            assert!(!lets_in(&loopback, &[("host", "localhost:4000"), ("origin", origin)]), "{origin}");
        }
        for site in ["cross-site", "same-site"] {
            assert!(!lets_in(&loopback, &[("host", "localhost:4000"), ("sec-fetch-site", site)]), "{site}");
        }
        assert!(lets_in(&guard("10.0.0.1"), &[("host", "10.0.0.1:4000")]));
        assert!(lets_in(&guard("0.0.0.0"), &[("host", "10.0.0.1:4000")]));
        assert!(!lets_in(&guard("0.0.0.0"), &[("host", "evil.example")]));
    }

    #[test]
    fn the_token_stands_first_and_is_whole() {
        let guard = guard("127.0.0.1");
        let token = guard.token();
        assert_eq!(token.len(), 32);
        assert_eq!(guard.behind_token(&format!("/{token}/state")), Some("state"));
        assert_eq!(guard.behind_token(&format!("/{token}/")), Some(""));
        for path in [
            "/",
            "",
            "//",
            "/state",
            &format!("/{token}"),
            &format!("/{}/state", &token[1..]),
            &format!("/{token}0/"),
            &format!("{token}/"),
        ] {
            assert_eq!(guard.behind_token(path), None, "{path}");
        }
        assert!(guard.lacks_slash(&format!("/{token}")));
        for path in ["/", "", &format!("/{token}/"), &format!("/{}", &token[1..]), token, &format!("//{token}")] {
            assert!(!guard.lacks_slash(path), "{path}");
        }
        assert_ne!(token, Guard::new(guard.address).expect("random numbers").token());
    }
}
