//! Who is let in, over a real connection.

use super::folder::Folder;
use super::recent::Recent;
use super::routes;
use super::served::Studio;
use super::settings::Settings;
use crate::cli::questions::Program;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

/// A studio on a folder with a scene, a link that leads out, and a secret beside it.
struct Served {
    base: tempfile::TempDir,
    port: u16,
    token: String,
}

impl Served {
    fn new() -> Self {
        let base = tempfile::tempdir().unwrap();
        let folder = base.path().join("open");
        std::fs::create_dir(&folder).unwrap();
        std::fs::copy(
            "scenarios/rocker/two_masses.json",
            folder.join("scene.json"),
        )
        .unwrap();
        std::fs::write(base.path().join("secret.json"), "{\"dam\": 1}").unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(base.path().join("secret.json"), folder.join("link.json"))
            .unwrap();
        let recent = Recent::in_folder(&base.path().join("recent"));
        let (send, receive) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread()
                .enable_all()
                .build();
            runtime.unwrap().block_on(async {
                let (folder, scene) = Folder::open(Some(&folder)).unwrap();
                let listener = routes::listen(None).await.unwrap();
                let port = listener.local_addr().unwrap().port();
                let mut studio = Studio::new((folder, scene), port, &Program).unwrap();
                studio.recent = recent;
                studio.settings = Settings::at(None);
                let studio = Arc::new(studio);
                send.send((port, studio.token().text().to_owned())).unwrap();
                routes::run(studio, listener).await;
            });
        });
        let (port, token) = receive.recv().unwrap();
        Self { base, port, token }
    }

    fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    fn say(&self, request: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(30)))
            .unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        // A connection that is cut has said what it says.
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// Status and answer of a request with these headers.
    fn ask(&self, line: &str, headers: &[&str]) -> (u16, String) {
        let headers: String = headers.iter().map(|one| format!("{one}\r\n")).collect();
        let answer = self.say(&format!(
            "{line} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n"
        ));
        let status = answer
            .split(' ')
            .nth(1)
            .and_then(|status| status.parse().ok());
        (status.unwrap_or(0), answer)
    }

    /// What a WebSocket is sent until it is closed, where it says this.
    fn upgrade(&self, frames: &[u8]) -> Vec<u8> {
        let head = format!(
            "GET /ws HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
            self.host()
        );
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(30)))
            .unwrap();
        stream
            .write_all(&[head.as_bytes(), frames].concat())
            .unwrap();
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let at = answer
            .windows(4)
            .position(|four| four == b"\r\n\r\n")
            .unwrap();
        assert!(answer.starts_with(b"HTTP/1.1 101"));
        answer.split_off(at + 4)
    }
}

/// A message of a window, masked with zeros, as nobody forbids.
fn frame(text: &str) -> Vec<u8> {
    let length = u16::try_from(text.len()).unwrap();
    let mut frame = match u8::try_from(length) {
        Ok(short) if short < 126 => vec![0x81, 0x80 | short],
        _ => [&[0x81, 0x80 | 126], &length.to_be_bytes()[..]].concat(),
    };
    frame.extend_from_slice(&[0; 4]);
    frame.extend_from_slice(text.as_bytes());
    frame
}

fn hello(token: &str) -> Vec<u8> {
    frame(&format!("{{\"type\":\"hello\",\"token\":\"{token}\"}}"))
}

#[test]
fn the_page_has_a_nonce_of_its_own_and_the_headers_that_keep_it() {
    let served = Served::new();
    let host = format!("Host: {}", served.host());
    let ask = || served.ask("GET /", &[&host]);
    let (status, page) = ask();
    assert_eq!(status, 200);
    let nonce = |page: &str| {
        page.split("'nonce-")
            .nth(1)
            .unwrap()
            .split('\'')
            .next()
            .unwrap()
            .to_owned()
    };
    let policy = format!(
        "content-security-policy: default-src 'self'; style-src 'self' 'nonce-{}'; img-src 'self' blob: data:; \
         frame-ancestors 'none'; base-uri 'none'; form-action 'none'\r\n",
        nonce(&page)
    );
    assert!(page.contains(&policy), "{page}");
    assert!(page.contains(&format!("content=\"{}\"", nonce(&page))));
    assert!(
        page.contains("x-content-type-options: nosniff")
            && page.contains("referrer-policy: no-referrer")
    );
    assert!(!page.contains(&served.token));
    assert_ne!(nonce(&page), nonce(&ask().1));
    for path in [
        "/studio.js",
        "/studio.css",
        "/look.css",
        "/plot.js",
        "/player.js",
    ] {
        assert_eq!(
            served.ask(&format!("GET {path}"), &[&host]).0,
            200,
            "{path}"
        );
    }
}

#[test]
fn only_rightful_requests_are_answered() {
    let served = Served::new();
    let host = format!("Host: {}", served.host());
    let bearer = format!("Authorization: Bearer {}", served.token);
    let own = format!("Origin: http://{}", served.host());
    let (status, scenes) = served.ask("GET /api/scenes", &[&host, &bearer]);
    assert_eq!(status, 200);
    assert!(
        scenes.contains("scene.json") && !scenes.contains("link.json"),
        "{scenes}"
    );
    let rightful = [
        "GET /api/first",
        "GET /api/schema?scene=scene.json",
        "GET /api/parts?scene=scene.json",
        "GET /api/model?scene=scene.json",
        "GET /api/figures?scene=scene.json",
        "GET /api/linkages?scene=scene.json",
        "GET /api/linkages?scene=scene.json&at=%7B%22x%22%3A%5B1%5D%7D",
        "GET /api/linkages?scene=scene.json&at=%5B",
        "GET /api/questions?scene=scene.json",
        "GET /api/text?scene=scene.json",
        "GET /api/file?scene=scene.json&question=%7B%22command%22%3A%22run%22%7D&name=summary.json",
    ];
    for question in rightful {
        let (status, answer) = served.ask(question, &[&host, &bearer, &own]);
        assert_eq!(status, 200, "{answer}");
        assert_eq!(served.ask(question, &[&host]).0, 401);
    }
    // What no form has is refused, and nothing is written.
    let out = served.base.path().join("out");
    let sly = format!(
        "GET /api/file?scene=scene.json&name=x&question=%7B%22command%22%3A%22kinematics%22%2C%22options%22%3A%7B%22out%22%3A%5B%22{}%22%5D%7D%7D",
        out.display()
    );
    assert_eq!(served.ask(&sly, &[&host, &bearer]).0, 422);
    assert!(!out.exists());
    let port = served.port;
    let (wrong, twice) = (
        format!("Authorization: Bearer {}", "0".repeat(64)),
        format!("{host}\r\n{host}"),
    );
    let (localhost, absolute) = (
        format!("Host: localhost:{port}"),
        format!("GET http://evil.example:{port}/api/scenes"),
    );
    let upgrade = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    let cases: &[(&str, &[&str], u16)] = &[
        ("GET /", &["Host: evil.example"], 403),
        ("GET /", &[&localhost], 403),
        ("GET /", &[&twice], 403),
        ("GET /", &[], 403),
        (&absolute, &[&host, &bearer], 403),
        ("GET /api/scenes", &[&host], 401),
        ("GET /api/first", &[&host], 401),
        ("GET /api/first", &[&host, &wrong], 401),
        ("GET /api/scenes", &[&host, &wrong], 401),
        ("GET /api/scenes", &[&host, &bearer, &bearer], 401),
        (
            "GET /api/scenes",
            &[&host, &bearer, "Origin: http://evil.example"],
            403,
        ),
        (
            "GET /api/scenes",
            &[&host, &bearer, "Sec-Fetch-Site: cross-site"],
            403,
        ),
        ("POST /api/scenes", &[&host, &bearer], 403),
        ("POST /api/scenes", &[&host, &bearer, &own], 405),
        (
            "GET /api/schema?scene=../secret.json",
            &[&host, &bearer],
            404,
        ),
        (
            "GET /api/schema?scene=%2e%2e/secret.json",
            &[&host, &bearer],
            404,
        ),
        ("GET /api/schema?scene=link.json", &[&host, &bearer], 404),
        ("GET /api/model?scene=link.json", &[&host, &bearer], 404),
        ("GET /api/figures?scene=link.json", &[&host, &bearer], 404),
        ("GET /api/figures?scene=scene.json", &[&host], 401),
        ("GET /api/model?scene=scene.json", &[&host], 401),
        (
            "GET /api/parts?scene=../secret.json",
            &[&host, &bearer],
            404,
        ),
        ("GET /../secret.json", &[&host, &bearer], 404),
        ("GET /ws", &[&host, upgrade], 403),
        ("GET /ws", &[&host, upgrade, "Origin: null"], 403),
    ];
    for (line, headers, wanted) in cases {
        let (status, answer) = served.ask(line, headers);
        assert_eq!(status, *wanted, "{line} {headers:?}: {answer}");
        let folder = served.base.path().display().to_string();
        assert!(
            !answer.contains(&folder) && !answer.contains(&served.token),
            "{answer}"
        );
    }
}

#[test]
fn a_websocket_without_the_token_is_told_nothing() {
    let served = Served::new();
    let told = |answer: &[u8]| {
        answer
            .first()
            .is_some_and(|first| [1, 2].contains(&(first & 0x0f)))
    };
    for said in [
        hello(&"0".repeat(64)),
        hello(""),
        frame("{\"type\":\"open\",\"scene\":\"scene.json\"}"),
        frame("["),
        vec![0x82, 0x80, 0, 0, 0, 0],
        vec![0x01, 0x02, b'{', b'}'],
    ] {
        assert!(!told(&served.upgrade(&said)), "{said:?}");
    }
    // With it, it is; what no window says ends it.
    let nothing = frame("{\"type\":\"nothing\"}");
    let answer = served.upgrade(&[hello(&served.token), nothing].concat());
    assert!(told(&answer) && String::from_utf8_lossy(&answer).contains("welcome"));
}

#[test]
fn a_window_comes_back_by_proofs_alone() {
    let served = Served::new();
    let token = crate::studio::server::token::Token::of(&served.token);
    let back = |name: &str| {
        let number = "7".repeat(64);
        frame(&format!(
            "{{\"type\":\"back\",\"name\":\"{name}\",\"number\":\"{number}\",\"tab\":\"\",\"author\":\"me\"}}"
        ))
    };
    let nobody = served.upgrade(&back(&"0".repeat(64)));
    assert!(!String::from_utf8_lossy(&nobody).contains("challenge"));
    // The program proves that it has the token, and gives it to nobody who does not.
    for wrong in [served.token.as_str(), "", token.proof("window", "").text()] {
        let proof = frame(&format!("{{\"type\":\"proof\",\"proof\":\"{wrong}\"}}"));
        let answer = served.upgrade(&[back(&token.name()), proof].concat());
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let own = token.proof("program", &"7".repeat(64));
        assert!(answer.contains("challenge") && answer.contains(own.text()));
        assert!(!answer.contains("welcome") && !answer.contains(&served.token));
    }
}

#[test]
fn new_scenes_are_made_within_the_folder_and_over_nothing() {
    let served = Served::new();
    let folder = served.base.path().join("open");
    let before = std::fs::read(folder.join("scene.json")).unwrap();
    let secret = std::fs::read(served.base.path().join("secret.json")).unwrap();
    let nothing = frame("{\"type\":\"nothing\"}");
    for from in [
        "",
        ",\"from\":{\"template\":\"lever\"}",
        ",\"from\":{\"scenario\":\"rocker/two_masses\"}",
    ] {
        for name in [
            "scene.json",
            "link.json",
            "../secret.json",
            "../out.json",
            "/tmp/out.json",
            "deep/out.json",
            "out.txt",
        ] {
            let new = frame(&format!("{{\"type\":\"new\",\"scene\":\"{name}\"{from}}}"));
            let answer = served.upgrade(&[hello(&served.token), new, nothing.clone()].concat());
            let answer = String::from_utf8_lossy(&answer).into_owned();
            let is_refused = answer.contains("\"type\":\"error\"") && !answer.contains("opened");
            // A platform without links has no such file, and makes one.
            let is_free = name == "link.json" && cfg!(not(unix));
            assert!(is_refused || is_free, "{name}: {answer}");
        }
    }
    assert_eq!(std::fs::read(folder.join("scene.json")).unwrap(), before);
    assert_eq!(
        std::fs::read(served.base.path().join("secret.json")).unwrap(),
        secret
    );
    assert!(!served.base.path().join("out.json").exists());
    for (from, wanted) in [
        ("{\"template\":\"nothing\"}", false),
        ("{\"scenario\":\"../secret\"}", false),
        ("{\"scenario\":\"rocker/two_masses\"}", true),
    ] {
        let new = format!("{{\"type\":\"new\",\"scene\":\"made.json\",\"from\":{from}}}");
        let answer = served.upgrade(&[hello(&served.token), frame(&new), nothing.clone()].concat());
        let is_opened = String::from_utf8_lossy(&answer).contains("opened");
        assert_eq!(
            (is_opened, folder.join("made.json").exists()),
            (wanted, wanted),
            "{from}"
        );
    }
}

#[test]
fn the_interface_is_small() {
    // Measured compressed by `.ci/run`; what stands here bounds it from above.
    let sizes = ["index.html", "studio.js", "studio.css"].map(|name| {
        std::fs::metadata(format!("studio/dist/{name}"))
            .unwrap()
            .len()
    });
    assert!(sizes.iter().sum::<u64>() < 700_000, "{sizes:?}");
    assert!(super::routes::PAGE.contains("NONCE"));
}
