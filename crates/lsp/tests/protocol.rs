//! The real protocol, spoken by a client of our own over the connection that an editor has.

use lsp_server::{Connection, Message, Notification, Request, RequestId, Response};
use serde_json::{Value, json};
use std::time::Duration;

/// An editor with a scene open.
struct Editor {
    connection: Connection,
    server: Option<std::thread::JoinHandle<()>>,
    next: i32,
    version: i32,
    uri: String,
}

const LONG: Duration = Duration::from_secs(60);

impl Editor {
    fn open(uri: &str, text: &str) -> Self {
        let (server, client) = Connection::memory();
        let thread = std::thread::spawn(move || tracer_lsp::serve(&server).expect("a whole conversation"));
        let mut editor = Editor { connection: client, server: Some(thread), next: 0, version: 0, uri: uri.to_owned() };
        let answer = editor.ask("initialize", json!({ "processId": null, "rootUri": null, "capabilities": {} }));
        assert_eq!(answer["serverInfo"]["name"], "tracer");
        assert_eq!(answer["capabilities"]["positionEncoding"], "utf-16");
        editor.tell("initialized", json!({}));
        let document = json!({ "uri": uri, "languageId": "ron", "version": 0, "text": text });
        editor.tell("textDocument/didOpen", json!({ "textDocument": document }));
        editor
    }

    fn tell(&self, method: &str, params: Value) {
        let notification = Notification { method: method.to_owned(), params };
        self.connection.sender.send(Message::Notification(notification)).expect("a server");
    }

    fn response(&mut self, method: &str, params: Value) -> Response {
        self.next += 1;
        let id = RequestId::from(self.next);
        let request = Request { id: id.clone(), method: method.to_owned(), params };
        self.connection.sender.send(Message::Request(request)).expect("a server");
        loop {
            match self.connection.receiver.recv_timeout(LONG).expect("an answer") {
                Message::Response(response) if response.id == id => return response,
                _ => {}
            }
        }
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        let response = self.response(method, params);
        assert!(response.error.is_none(), "{method}: {:?}", response.error);
        response.result.unwrap_or(Value::Null)
    }

    /// Asks about a place.
    fn at(&mut self, method: &str, line: u32, character: u32) -> Value {
        let uri = self.uri.clone();
        self.ask(
            method,
            json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": character } }),
        )
    }

    fn write(&mut self, text: &str) {
        self.version += 1;
        let document = json!({ "uri": self.uri, "version": self.version });
        let changes = json!([{ "text": text }]);
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
    }

    /// The next diagnostics of this version.
    fn diagnostics(&mut self) -> Vec<Value> {
        loop {
            if let Message::Notification(told) = self.connection.receiver.recv_timeout(LONG).expect("diagnostics")
                && told.method == "textDocument/publishDiagnostics"
                && told.params["version"] == self.version
            {
                return told.params["diagnostics"].as_array().expect("a list").clone();
            }
        }
    }

    fn close(mut self) {
        self.ask("shutdown", Value::Null);
        self.tell("exit", Value::Null);
        self.server.take().expect("a server").join().expect("an orderly end");
    }
}

const SCENE: &str = "\
Scene(
    background: 1,
    materials: { \"red\": Diffuse(albedo: \"#ff0000\") },
    objects: [Sphere(center: (0, 0, 0), radus: 1, material: \"red\")],
)
";

#[test]
fn a_scene_is_mended_and_laid_out() {
    let mut editor = Editor::open("file:///scenes/a.ron", SCENE);
    let told = editor.diagnostics();
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!(told[0]["range"]["start"], json!({ "line": 3, "character": 40 }));
    assert!(told[0]["message"].as_str().expect("text").contains("radus"));
    let uri = editor.uri.clone();
    let range = told[0]["range"].clone();
    let context = json!({ "diagnostics": told });
    let document = json!({ "uri": uri });
    let actions =
        editor.ask("textDocument/codeAction", json!({ "textDocument": document, "range": range, "context": context }));
    assert_eq!(actions[0]["edit"]["changes"][&uri][0]["newText"], "radius");
    editor.write(&SCENE.replace("radus", "radius").replace("background: 1", "background:1"));
    assert_eq!(editor.diagnostics(), Vec::<Value>::new());
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let tidy = editor.ask("textDocument/formatting", json!({ "textDocument": document, "options": options }));
    assert!(tidy[0]["newText"].as_str().expect("text").contains("\n    background: 1,\n"));
    editor.close();
}

#[test]
fn words_and_names_are_known() {
    let text = SCENE.replace("radus: 1, ", "");
    let mut editor = Editor::open("file:///scenes/a.ron", &text);
    let column = text.lines().nth(3).expect("a line").find("material").expect("a word") as u32;
    let items = editor.at("textDocument/completion", 3, column);
    let labels: Vec<&str> =
        items.as_array().expect("a list").iter().map(|item| item["label"].as_str().expect("text")).collect();
    assert!(labels.contains(&"radius") && !labels.contains(&"center"), "{labels:?}");
    let hover = editor.at("textDocument/hover", 3, column + 2);
    assert!(hover["contents"]["value"].as_str().expect("text").contains("**material**"));
    let name = column + "material: \"r".len() as u32;
    let definition = editor.at("textDocument/definition", 3, name);
    assert_eq!(definition["range"]["start"], json!({ "line": 2, "character": 18 }));
    let uri = editor.uri.clone();
    let place = json!({ "line": 3, "character": name });
    let renamed = editor
        .ask("textDocument/rename", json!({ "textDocument": { "uri": uri }, "position": place, "newName": "crimson" }));
    assert_eq!(renamed["changes"][&uri].as_array().expect("edits").len(), 2);
    let refused = editor
        .response("textDocument/rename", json!({ "textDocument": { "uri": uri }, "position": place, "newName": "" }));
    assert!(refused.error.expect("refused").message.contains("letter"));
    let outline = editor.ask("textDocument/documentSymbol", json!({ "textDocument": { "uri": uri } }));
    assert_eq!(outline[1]["children"][0]["name"], "red");
    let colors = editor.ask("textDocument/documentColor", json!({ "textDocument": { "uri": uri } }));
    assert_eq!(colors[0]["color"], json!({ "red": 1.0, "green": 0.0, "blue": 0.0, "alpha": 1.0 }));
    let blue = json!({ "red": 0.0, "green": 0.0, "blue": 1.0, "alpha": 1.0 });
    let range = colors[0]["range"].clone();
    let texts = editor.ask(
        "textDocument/colorPresentation",
        json!({ "textDocument": { "uri": uri }, "color": blue, "range": range }),
    );
    assert_eq!(texts[0]["label"], "\"#0000ff\"");
    assert!(editor.response("textDocument/nothing", json!({})).error.is_some());
    assert!(editor.response("textDocument/hover", json!({ "wrong": 1 })).error.is_some());
    editor.close();
}

/// Files are looked at when a scene is opened and saved, and offered by name.
#[test]
fn files_are_looked_at() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("gem.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    std::fs::create_dir(folder.path().join("more")).expect("a folder");
    let uri = format!("file://{}", folder.path().join("a b.ron").display()).replace(' ', "%20");
    let text = "Scene(background: 1, objects: [Mesh(file: \"gen.obj\")])";
    let mut editor = Editor::open(&uri, text);
    assert!(editor.diagnostics().is_empty());
    let told = editor.diagnostics();
    assert!(told[0]["message"].as_str().expect("text").contains("gem.obj"), "{told:?}");
    editor.write(&text.replace("gen.obj", ""));
    let items = editor.at("textDocument/completion", 0, 43);
    let labels: Vec<&Value> = items.as_array().expect("a list").iter().map(|item| &item["label"]).collect();
    assert_eq!(labels, ["gem.obj", "more/"]);
    editor.write(&text.replace("gen", "gem"));
    assert!(editor.diagnostics().is_empty());
    editor.tell("textDocument/didSave", json!({ "textDocument": { "uri": uri } }));
    assert!(editor.diagnostics().is_empty() && editor.diagnostics().is_empty());
    editor.close();
}

/// A hundred edits, one letter each, from nothing to a scene: the server answers between them all.
#[test]
fn a_scene_is_typed_letter_by_letter() {
    let whole = SCENE.replace("radus", "radius");
    let mut editor = Editor::open("untitled:Untitled-1", "");
    for end in (0..=whole.len()).step_by(2) {
        editor.write(&whole[..end]);
        let last = whole[..end].lines().count().max(1) as u32 - 1;
        let uri = editor.uri.clone();
        editor.at("textDocument/completion", last, 1000);
        editor.at("textDocument/hover", last, 3);
        editor.ask("textDocument/documentSymbol", json!({ "textDocument": { "uri": uri } }));
    }
    editor.write(&whole);
    assert!(editor.diagnostics().is_empty());
    editor.close();
}

/// Of a film all frames are looked at, and of several cameras none needs to be chosen.
#[test]
fn other_frames_are_looked_at_and_no_camera_is_asked_for() {
    let text = "Scene(animation: Animation(frames: 4), background: 1, cameras: { \"a\": Camera(), \"b\": Camera() }, \
                objects: [Sphere(center: (0, 0, 0), radius: \"=2.5 - frame\")])";
    let mut editor = Editor::open("file:///scenes/film.ron", text);
    assert_eq!(editor.diagnostics(), Vec::<Value>::new());
    let told = editor.diagnostics();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0]["message"].as_str().expect("text").contains("(frame 3)"), "{told:?}");
    editor.close();
}

/// Of files that are no scenes nothing is told, and nothing in them is changed.
#[test]
fn files_of_other_programs_are_left_alone() {
    let text = "[package]\nname = \"a\"\nversion = \"0.1.0\"\n\n[dependencies]\nserde={version=\"1\"}\n";
    let mut editor = Editor::open("file:///nowhere/Cargo.toml", text);
    assert_eq!(editor.diagnostics(), Vec::<Value>::new());
    for method in ["completion", "hover", "definition", "prepareRename"] {
        assert_eq!(editor.at(&format!("textDocument/{method}"), 1, 2), Value::Null, "{method}");
    }
    let document = json!({ "uri": editor.uri });
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let tidy = editor.ask("textDocument/formatting", json!({ "textDocument": document, "options": options }));
    assert_eq!(tidy, Value::Null);
    // It becomes one as soon as a scene's words stand in it.
    editor.write("background = 1\n\n[[objects]]\nSphere = { center = [0, 0, 0], radus = 1 }\n");
    assert_eq!(editor.diagnostics().len(), 1);
    editor.write("# a room\n\nob");
    let items = editor.at("textDocument/completion", 2, 2);
    assert!(items.as_array().expect("a list").iter().any(|item| item["label"] == "objects"), "{items}");
    editor.close();
}

/// From the name of a file one goes to the file, and a name shows what it stands for.
#[test]
fn files_are_gone_to_and_names_are_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a gem.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    std::fs::write(folder.path().join("part.ron"), "Scene(objects: [Box()])").expect("a file");
    let uri = format!("file://{}/a.ron", folder.path().display());
    let text = "Scene(background: 1, materials: { \"red\": Diffuse(albedo: (1, 0, 0)) }, objects: [\n\
                Mesh(file: \"a gem.obj\", material: \"red\"),\n\
                Include(file: \"part.ron\"),\n\
                Mesh(file: \"none.obj\"),\n])";
    let mut editor = Editor::open(&uri, text);
    let found = editor.at("textDocument/definition", 1, 14);
    let place = found["uri"].as_str().expect("an address");
    assert!(place.starts_with("file:///") && place.ends_with("/a%20gem.obj"), "{place}");
    assert_eq!(found["range"]["start"], json!({ "line": 0, "character": 0 }));
    let found = editor.at("textDocument/definition", 2, 18);
    assert!(found["uri"].as_str().expect("an address").ends_with("/part.ron"), "{found}");
    assert_eq!(editor.at("textDocument/definition", 3, 14), Value::Null);
    let column = text.lines().nth(1).and_then(|line| line.find("red")).expect("a word") as u32;
    let shown = editor.at("textDocument/hover", 1, column + 1);
    assert_eq!(shown["contents"]["value"], "**red**: `Diffuse(albedo: (1, 0, 0))`");
    editor.close();
}

/// What an included file gives is gone to and shown from the scene, and renamed in both; the file has nothing to
/// render, which is no fault of it.
#[test]
fn names_of_included_files_are_known() {
    let folder = tempfile::tempdir().expect("a folder");
    let library = "Scene(vars: { \"h\": 2 },\nmaterials: { \"red\": Mirror() })";
    std::fs::write(folder.path().join("lib.ron"), library).expect("a file");
    let scene = "Scene(background: 1, include: [\"lib.ron\"], objects: [\nBox(size: \"=h\", material: \"red\"),\n])";
    std::fs::write(folder.path().join("a.ron"), scene).expect("a file");
    let uri = |name: &str| format!("file://{}/{name}", folder.path().display());
    let column = |text: &str, line: usize, word: &str| {
        text.lines().nth(line).and_then(|line| line.find(word)).expect("a word") as u32 + 1
    };
    let mut editor = Editor::open(&uri("a.ron"), scene);
    for (word, line, start) in [("red", 1, 14), ("h\"", 0, 15)] {
        let found = editor.at("textDocument/definition", 1, column(scene, 1, word));
        assert!(found["uri"].as_str().expect("an address").ends_with("/lib.ron"), "{found}");
        assert_eq!(found["range"]["start"], json!({ "line": line, "character": start }));
    }
    let shown = editor.at("textDocument/hover", 1, column(scene, 1, "red"));
    assert_eq!(shown["contents"]["value"], "**red**: `Mirror()`");
    editor.close();
    // The scene is not open.
    let mut editor = Editor::open(&uri("lib.ron"), library);
    assert!(editor.diagnostics().is_empty());
    let place = json!({ "line": 1, "character": column(library, 1, "red") });
    let asked = json!({ "textDocument": { "uri": uri("lib.ron") }, "position": place.clone(), "newName": "blue" });
    let renamed = editor.ask("textDocument/rename", asked);
    let changes = renamed["changes"].as_object().expect("changes");
    assert_eq!(changes.len(), 2, "{renamed}");
    let of_scene = changes.iter().find(|(uri, _)| uri.ends_with("/a.ron")).expect("the scene's").1;
    assert_eq!(of_scene[0]["newText"], "blue");
    assert_eq!(of_scene[0]["range"]["start"], json!({ "line": 1, "character": column(scene, 1, "red") - 1 }));
    // What the scene has itself is not to be taken for that.
    let own = scene.replace("include", "materials: { \"blue\": Mirror() }, include");
    std::fs::write(folder.path().join("a.ron"), own).expect("a file");
    let asked = json!({ "textDocument": { "uri": uri("lib.ron") }, "position": place, "newName": "blue" });
    let refused = editor.response("textDocument/rename", asked).error.expect("refused");
    assert!(refused.message.contains("another \"blue\" already in"), "{}", refused.message);
    editor.close();
}

/// A value shows what its field takes.
#[test]
fn values_show_what_they_may_be() {
    let text = "[camera]\nfov = 35\n\n[[objects]]\nSphere = { center = [0, 1.5, 0], radius = 1 }\n";
    let mut editor = Editor::open("file:///scenes/a.toml", text);
    let shown = editor.at("textDocument/hover", 1, 7);
    let told = shown["contents"]["value"].as_str().expect("text");
    assert!(told.starts_with("**fov**") && told.contains("degrees") && told.contains("default `"), "{told}");
    let range = json!({ "start": { "line": 1, "character": 6 }, "end": { "line": 1, "character": 8 } });
    assert_eq!(shown["range"], range);
    let shown = editor.at("textDocument/hover", 4, 25);
    assert!(shown["contents"]["value"].as_str().expect("text").starts_with("**center**"), "{shown}");
    editor.close();
}

/// An editor that has not said that it knows snippets gets none of their signs.
#[test]
fn snippets_are_for_those_who_know_them() {
    let mut editor = Editor::open("file:///scenes/a.ron", "Scene(camera: Camera(pos))\n");
    let items = editor.at("textDocument/completion", 0, 24);
    let item = items.as_array().expect("a list").iter().find(|item| item["label"] == "position").expect("a field");
    assert_eq!((&item["insertTextFormat"], &item["textEdit"]["newText"]), (&json!(1), &json!("position: ()")));
    editor.close();
}

/// In a header of TOML names alone are written.
#[test]
fn headers_get_names_alone() {
    let mut editor = Editor::open("file:///scenes/a.toml", "background = 1\n[[obj]]\n");
    for (text, line, character, label) in [
        ("background = 1\n[ren]\n", 1, 4, "render"),
        ("background = 1\n[[li]]\n", 1, 4, "lights"),
        ("background = 1\n[objects.]\n", 1, 9, "Sphere"),
    ] {
        editor.write(text);
        let items = editor.at("textDocument/completion", line, character);
        let items = items.as_array().expect("a list");
        let item = items.iter().find(|item| item["label"] == label).unwrap_or_else(|| panic!("{label} in {text}"));
        assert_eq!(item["textEdit"]["newText"], label);
    }
    editor.close();
}

/// Edits that mend a fault are preferred; those after which as much is wrong are offered, and no more.
#[test]
fn edits_that_mend_are_preferred() {
    let sphere = |radius: &str| {
        let sphere = format!("{{ \"Sphere\": {{ \"center\": [0, 0, 0], {radius} }} }}");
        format!("{{ \"background\": 1, \"objects\": [{sphere}] }}")
    };
    let mut editor = Editor::open("file:///scenes/a.json", &sphere("\"radius\": 1"));
    let preferred = |editor: &mut Editor, text: &str| -> Vec<Value> {
        editor.write(text);
        let (uri, told) = (editor.uri.clone(), editor.diagnostics());
        let last = text.lines().count() as u32;
        let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": last, "character": 0 } });
        let params = json!({ "textDocument": { "uri": uri }, "range": range, "context": { "diagnostics": told } });
        let actions = editor.ask("textDocument/codeAction", params);
        actions.as_array().expect("a list").iter().map(|action| action["isPreferred"].clone()).collect()
    };
    assert_eq!(preferred(&mut editor, &sphere("\"radus\": 1")), [json!(true)]);
    // A radius is not null, either.
    assert_eq!(preferred(&mut editor, &sphere("\"radius\": undefined")), [Value::Null]);
    // Of a long scene nobody says: it would take too long.
    let long = format!("{}{}", sphere("\"radus\": 1"), " ".repeat(64 << 10));
    assert_eq!(preferred(&mut editor, &long), [Value::Null]);
    editor.close();
}

/// A material that is named and not there is added by an action, where no name is near.
#[test]
fn a_material_that_is_not_there_is_added() {
    let text = "Scene(background: 1, objects: [Box(size: 1, material: \"moss\")])";
    let mut editor = Editor::open("file:///scenes/a.ron", text);
    let (uri, told) = (editor.uri.clone(), editor.diagnostics());
    let range = told[0]["range"].clone();
    let params = json!({ "textDocument": { "uri": uri }, "range": range, "context": { "diagnostics": told } });
    let actions = editor.ask("textDocument/codeAction", params);
    assert_eq!(actions[0]["title"], "Add a material \"moss\"");
    let edit = &actions[0]["edit"]["changes"][&uri][0];
    assert_eq!(edit["newText"], "materials: { \"moss\": Diffuse(albedo: 0.5) }, ");
    assert_eq!(edit["range"]["start"]["character"], 21);
    editor.close();
}

/// A scene with errors is not laid out, and the editor is told why.
#[test]
fn why_a_scene_is_not_laid_out_is_told() {
    let mut editor = Editor::open("file:///scenes/a.ron", SCENE);
    let document = json!({ "uri": editor.uri });
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let response = editor.response("textDocument/formatting", json!({ "textDocument": document, "options": options }));
    let error = response.error.expect("it is wrong");
    // The protocol's RequestFailed.
    assert_eq!(error.code, -32803);
    assert!(error.message.contains("radus"), "{}", error.message);
    editor.close();
}
