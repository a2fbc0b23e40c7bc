//! Who is let in, and that there is nothing to be had but the page and the pictures.

use crate::support::{SCENE, Sandbox};

#[test]
fn the_page_comes_with_its_files_and_is_shut_to_others() {
    let sandbox = Sandbox::new(SCENE);
    let page = sandbox.get("");
    assert_eq!(page.status, 200);
    for word in [
        "content-security-policy: default-src 'none'",
        "referrer-policy: no-referrer",
        "cache-control: no-store",
        "nosniff",
    ] {
        assert!(page.head.contains(word), "{word}: {}", page.head);
    }
    // All that the page loads is here, and nothing of it is elsewhere.
    let mut files = vec![page.text()];
    for name in ["page.css", "main.js", "view.js", "net.js", "faults.js", "camera.js", "inspector.js", "compare.js"] {
        let file = sandbox.get(name);
        assert_eq!(file.status, 200, "{name}");
        files.push(file.text());
    }
    for text in &files {
        let addresses = text.matches("://").count() - text.matches("http://www.w3.org/2000/svg").count();
        assert_eq!(addresses, 0, "an address of elsewhere: {text}");
    }
    for name in files[0].split("href=\"").skip(1).chain(files[0].split("src=\"").skip(1)) {
        let name = name.split('"').next().expect("a name");
        if !name.starts_with(['#', 'd', 's']) {
            assert_eq!(sandbox.get(name).status, 200, "{name}");
        }
    }
}

#[test]
fn without_the_token_there_is_nothing() {
    let sandbox = Sandbox::new(SCENE);
    let (host, token) = sandbox.place();
    let wrong = format!("{}{}", &token[..31], if token.ends_with('0') { '1' } else { '0' });
    for path in [
        "/",
        "/state",
        "/frame",
        &format!("/{wrong}"),
        &format!("/{wrong}/"),
        &format!("/{wrong}/state"),
        "//",
        "/favicon.ico",
    ] {
        let answer = sandbox.send(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"));
        assert_eq!((answer.status, answer.text().as_str()), (404, "not found"), "{path}");
    }
}

/// All that the page asks for goes on from the last slash, which is easily lost where an address is copied.
#[test]
fn the_address_without_its_last_slash_leads_to_the_page() {
    let sandbox = Sandbox::new(SCENE);
    let (host, token) = sandbox.place();
    let ask = |method: &str, path: &str, host: &str| {
        sandbox.send(&format!("{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"))
    };
    let answer = ask("GET", &format!("/{token}"), &host);
    assert_eq!(answer.status, 308);
    assert!(answer.head.contains(&format!("location: /{token}/\r\n")), "{}", answer.head);
    assert!(answer.head.contains("no-store") && answer.head.contains("no-referrer"), "{}", answer.head);
    let answer = ask("GET", &format!("/{token}?a=1"), &host);
    assert!(answer.head.contains(&format!("location: /{token}/?a=1\r\n")), "{}", answer.head);
    assert_eq!(ask("GET", &format!("/{token}/"), &host).status, 200);
    assert_eq!(ask("POST", &format!("/{token}"), &host).status, 404);
    assert_eq!(ask("GET", &format!("/{token}"), "evil.example").status, 403);
}

#[test]
fn requests_of_other_sites_are_refused() {
    let sandbox = Sandbox::new(SCENE);
    let (host, token) = sandbox.place();
    let port = host.rsplit(':').next().expect("a port");
    let ask =
        |lines: &str| sandbox.send(&format!("GET /{token}/state HTTP/1.1\r\n{lines}Connection: close\r\n\r\n")).status;
    assert_eq!(ask(&format!("Host: {host}\r\n")), 200);
    assert_eq!(ask(&format!("Host: localhost:{port}\r\n")), 200);
    assert_eq!(ask(&format!("Host: {host}\r\nOrigin: http://{host}\r\nSec-Fetch-Site: same-origin\r\n")), 200);
    // A name that another site has pointed here, a page of another site, no name.
    for lines in [
        format!("Host: evil.example:{port}\r\n"),
        format!("Host: {host}.evil.example\r\n"),
        format!("Host: {host}\r\nOrigin: http://evil.example\r\n"),
        format!("Host: {host}\r\nOrigin: null\r\n"),
        format!("Host: {host}\r\nOrigin: http://localhost:1\r\n"),
        format!("Host: {host}\r\nSec-Fetch-Site: cross-site\r\n"),
    ] {
        assert_eq!(ask(&lines), 403, "{lines}");
    }
    assert!(matches!(ask(""), 400 | 403));
}

#[test]
fn no_file_of_the_computer_is_given() {
    let sandbox = Sandbox::new(SCENE);
    sandbox.write("secret.txt", "secret");
    sandbox.done_after(0);
    let (_, token) = sandbox.place();
    for path in [
        "scene.ron",
        "secret.txt",
        "../secret.txt",
        "..%2fsecret.txt",
        "%2e%2e/secret.txt",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "save?kind=../secret.txt",
        "frame?layer=../secret.txt&tone=../secret.txt",
        "main.js/",
        "main.js%00",
        ".",
        "state/../secret.txt",
    ] {
        let answer = sandbox.get(path);
        assert!(matches!(answer.status, 400 | 404), "{path}: {}", answer.status);
        assert!(
            !answer.text().contains("secret\n") && answer.text() != "secret" && !answer.text().contains("root:"),
            "{path}"
        );
    }
    // Pages are told names, not folders.
    sandbox.write("scene.ron", SCENE.replace("radius", "radus").replace("0.8", "none.png"));
    let state = sandbox.until(|state| state["phase"] == "wrong").to_string();
    assert!(!state.contains(&*sandbox.folder.path().to_string_lossy()), "{state}");
    assert!(!state.contains(&token), "{state}");
}

#[test]
fn nonsense_is_refused_and_the_server_lives_on() {
    let sandbox = Sandbox::new(SCENE);
    let state = sandbox.done_after(0);
    let (host, token) = sandbox.place();
    for path in [
        "state?after=x",
        "state?after=-1",
        "state?after=99999999999999999999999",
        "frame?exposure=nan",
        "frame?exposure=inf",
        "frame?exposure=1e9",
        "frame?tone=x",
        "save",
        "save?kind=png&exposure=x",
    ] {
        assert_eq!(sandbox.get(path).status, 400, "{path}");
    }
    assert_eq!(sandbox.post("open", "{").status, 400);
    assert_eq!(sandbox.post("open", "{}").status, 400);
    assert_eq!(sandbox.post("open", &format!("{{\"told\": 0, \"version\": {}}}", state["version"])).status, 409);
    assert_eq!(sandbox.post("nothing", "{}").status, 404);
    assert_eq!(sandbox.post("open", &"x".repeat(100_000)).status, 413);
    let form =
        format!("POST /{token}/open HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: 2\r\n\r\n{{}}");
    assert_eq!(sandbox.send(&form).status, 415, "a form of another page sends no JSON");
    for request in [
        "",
        "\r\n\r\n",
        "GET\r\n\r\n",
        "\u{0}\u{1}",
        "PUT / HTTP/9.9\r\n\r\n",
        &format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(100_000)),
    ] {
        let mut stream = std::net::TcpStream::connect(&host).expect("it listens");
        let _ = std::io::Write::write_all(&mut stream, request.as_bytes());
    }
    assert_eq!(sandbox.get("state").status, 200);
}
