// The extension of docs/editors/vscode in an editor that is made of a few lines, with the real server. Run by `cargo xtask prove editors`.
// With --times it measures instead how long the server takes for a scene of 2000 lines.
"use strict";

const assert = require("node:assert/strict");
const { mkdtempSync, readFileSync, rmSync } = require("node:fs");
const Module = require("node:module");
const { tmpdir } = require("node:os");
const { join } = require("node:path");

const root = join(__dirname, "../../../..");
const extension = join(root, "docs/editors/vscode");
const program = process.env.TRACER ?? join(root, "target/debug/tracer");
const { Client } = require(join(extension, "client.js"));

const SCENE = `Scene(
    background:1,
    materials: { "red": Diffuse(albedo: "#ff0000") },
    objects: [Sphere(center: (0, 0, 0), radus: 1, material: "red")],
)
`;
const OTHERS = [
  ["toml", "Cargo.toml", readFileSync(join(root, "crates/lsp/Cargo.toml"), "utf8")],
  ["json", "package.json", readFileSync(join(extension, "package.json"), "utf8")],
];

/** As much of the editor as the extension uses. */
function editor() {
  const record = (...fields) => class { constructor(...values) { fields.forEach((field, k) => (this[field] = values[k])); } };
  const heard = {};
  const event = (name) => (listener) => { heard[name] = listener; return { dispose() {} }; };
  const providers = {};
  const register = (name) => (selector, provider, ...more) => { providers[name] = { provider, more }; return { dispose() {} }; };
  const marks = new Map();
  const told = [];
  const WorkspaceEdit = class { all = new Map(); set(uri, edits) { this.all.set(uri.toString(), edits); } };
  const vscode = {
    Position: record("line", "character"), Range: record("start", "end"), TextEdit: record("range", "newText"),
    Location: record("uri", "range"), Diagnostic: record("range", "message", "severity"), Hover: record("contents", "range"),
    DiagnosticRelatedInformation: record("location", "message"), CompletionItem: record("label", "kind"),
    MarkdownString: record("value"), SnippetString: record("value"), DocumentHighlight: record("range"),
    DocumentSymbol: record("name", "detail", "kind", "range", "selectionRange"), Color: record("red", "green", "blue", "alpha"),
    ColorInformation: record("range", "color"), ColorPresentation: record("label"), CodeAction: record("title", "kind"),
    CodeActionKind: { QuickFix: "quickfix" }, WorkspaceEdit,
    Uri: { parse: (text) => ({ toString: () => text }) },
    languages: {
      match: (selector, document) => (selector.some((one) => one.language === document.languageId) ? 10 : 0),
      createDiagnosticCollection: () => ({
        set: (uri, all) => { marks.set(uri.toString(), all); heard.marked?.(); }, clear: () => marks.clear(), dispose() {},
      }),
    },
    workspace: {
      textDocuments: [],
      applyEdit: async (all) => {
        for (const [uri, edits] of all.all) vscode.workspace.textDocuments.find((one) => one.uri.toString() === uri).apply(edits);
      },
      getConfiguration: () => ({ get: () => vscode.program }),
    },
    window: { showErrorMessage: (text) => { told.push(text); heard.marked?.(); }, createTerminal: () => assert.fail("no terminal") },
    commands: { registerCommand: (name, run) => { heard[name] = run; return { dispose() {} }; } },
    program,
  };
  for (const name of ["Hover", "Definition", "Reference", "DocumentHighlight", "Rename", "DocumentSymbol", "Color", "CodeActions",
    "DocumentFormattingEdit"]) vscode.languages[`register${name}Provider`] = register(name);
  vscode.languages.registerCompletionItemProvider = register("Completion");
  for (const name of ["OpenTextDocument", "ChangeTextDocument", "SaveTextDocument", "CloseTextDocument", "ChangeConfiguration"]) {
    vscode.workspace[`onDid${name}`] = event(name);
  }
  return { vscode, heard, providers, marks, told };
}

const { vscode, heard, providers, marks, told } = editor();
const load = Module._load;
Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));

/** Waits until it holds; looks again when marks or messages come. */
async function until(holds, what) {
  const end = setTimeout(() => { console.error(`in vain: ${what}`); process.exit(1); }, 20_000);
  while (!holds()) await new Promise((resolve) => { heard.marked = resolve; });
  clearTimeout(end);
}

function opened(languageId, uri, text) {
  const document = {
    languageId, version: 1, text, uri: vscode.Uri.parse(uri), getText: () => document.text,
    /** The place of a word's letter. */
    at(word, letter = 0) {
      const before = document.text.slice(0, document.text.indexOf(word) + letter).split("\n");
      return new vscode.Position(before.length - 1, before.at(-1).length);
    },
    byte: ({ line, character }) => document.text.split("\n").slice(0, line).join("\n").length + (line > 0) + character,
    write(text) {
      document.text = text;
      document.version += 1;
      heard.ChangeTextDocument({ document, contentChanges: [{}] });
    },
    apply(edits) {
      const last = [...edits].sort((a, b) => document.byte(b.range.start) - document.byte(a.range.start));
      document.write(last.reduce((text, { range, newText }) =>
        text.slice(0, document.byte(range.start)) + newText + text.slice(document.byte(range.end)), document.text));
    },
    marks: () => marks.get(uri),
  };
  vscode.workspace.textDocuments.push(document);
  heard.OpenTextDocument?.(document);
  return document;
}

async function everything(folder) {
  const scene = opened("ron", `file://${folder}/a.ron`, SCENE);
  const { activate, deactivate } = require(join(extension, "extension.js"));
  await activate({ subscriptions: [] });
  const manifest = JSON.parse(readFileSync(join(extension, "package.json"), "utf8"));
  for (const { command } of manifest.contributes.commands) assert.ok(heard[command], `nobody does ${command}`);
  const [{ configuration }] = manifest.contributes.languages;
  const [{ path }] = manifest.contributes.grammars;
  for (const name of [configuration, path]) JSON.parse(readFileSync(join(extension, name), "utf8"));
  const ask = (name, method, ...args) => providers[name].provider[method](...args);
  assert.ok(providers.Completion.more.includes("("));

  await until(() => scene.marks()?.length === 1, "a mark of the wrong scene");
  const [mark] = scene.marks();
  assert.deepEqual([mark.range.start, mark.severity, mark.source], [scene.at("radus"), 0, "tracer"]);
  assert.match(mark.message, /radus/);

  const [action] = await ask("CodeActions", "provideCodeActions", scene, mark.range);
  assert.equal(action.isPreferred, true);
  scene.apply(action.edit.all.get(scene.uri.toString()));
  assert.equal(scene.text, SCENE.replace("radus", "radius"));
  await until(() => scene.marks().length === 0, "no mark of the mended scene");

  scene.apply(await ask("DocumentFormattingEdit", "provideDocumentFormattingEdits", scene, { tabSize: 4, insertSpaces: true }));
  assert.match(scene.text, /\n    background: 1,\n/);

  const hover = await ask("Hover", "provideHover", scene, scene.at("radius: 1", 2));
  assert.match(hover.contents.value, /\*\*radius\*\*/);
  const items = await ask("Completion", "provideCompletionItems", scene, scene.at("radius: 1"));
  const labels = items.map(({ label }) => label);
  assert.ok(labels.includes("rotation") || labels.includes("transform"), labels.join());
  assert.ok(items.every((item) => item.insertText instanceof vscode.SnippetString && item.range instanceof vscode.Range));

  const use = scene.at('material: "red"', 'material: "r'.length);
  const [definition] = await ask("Definition", "provideDefinition", scene, use);
  assert.deepEqual(definition.range.start, scene.at('"red"', 1));
  assert.equal((await ask("Reference", "provideReferences", scene, use)).length, 2);
  assert.equal((await ask("DocumentHighlight", "provideDocumentHighlights", scene, use)).length, 2);
  assert.equal((await ask("Rename", "prepareRename", scene, use)).end.character - use.character, 2);
  await assert.rejects(ask("Rename", "prepareRename", scene, scene.at("Sphere")), /no name/);
  await assert.rejects(ask("Rename", "provideRenameEdits", scene, use, ""), /letter/);
  const renamed = await ask("Rename", "provideRenameEdits", scene, use, "crimson");
  scene.apply(renamed.all.get(scene.uri.toString()));
  assert.equal(scene.text.split('"crimson"').length, 3);

  const outline = await ask("DocumentSymbol", "provideDocumentSymbols", scene);
  assert.ok(outline.some(({ children }) => children.some(({ name }) => name === "crimson")));
  const [swatch] = await ask("Color", "provideDocumentColors", scene);
  assert.deepEqual({ ...swatch.color }, { red: 1, green: 0, blue: 0, alpha: 1 });
  const context = { document: scene, range: swatch.range };
  const [picked] = await ask("Color", "provideColorPresentations", new vscode.Color(0, 0, 1, 1), context);
  assert.equal(picked.textEdit.newText, '"#0000ff"');

  for (const [language, name, text] of OTHERS) {
    const other = opened(language, `file://${folder}/${name}`, text);
    await until(() => other.marks(), `an answer for ${name}`);
    assert.deepEqual(other.marks(), [], `${name} is marked`);
    vscode.window.activeTextEditor = { document: other };
    await heard["tracer.format"]();
    assert.equal(other.text, text);
    assert.deepEqual(await ask("Completion", "provideCompletionItems", other, other.at("name")), []);
  }
  const toml = opened("toml", `file://${folder}/a.toml`, "background = 1\n\n[[objects]]\nSphere = { center = [0, 0, 0], radus = 1 }\n");
  await until(() => toml.marks()?.length === 1, "a mark of a scene in TOML");
  toml.write(toml.text.replace("radus = 1", "radius =1"));
  await until(() => toml.marks().length === 0, "no mark of the mended scene in TOML");
  vscode.window.activeTextEditor = { document: toml };
  await heard["tracer.format"]();
  assert.match(toml.text, /radius = 1/);
  toml.write(toml.text.replace("radius", "radus"));
  await until(() => toml.marks().length === 1, "a mark again");
  heard.CloseTextDocument(toml);
  await until(() => toml.marks().length === 0, "no mark of what is closed");

  // Anew: all that is open is told again.
  scene.write(SCENE);
  await heard["tracer.restart"]();
  await until(() => scene.marks()?.length === 1, "a mark after a new start");
  assert.deepEqual(told, []);
  vscode.program = join(folder, "no-such-program");
  await heard.ChangeConfiguration({ affectsConfiguration: (name) => name === "tracer.path" });
  await until(() => told.length === 1, "a message where the program is missing");
  assert.match(told[0], /no-such-program.*tracer\.path/);
  assert.equal(await ask("Hover", "provideHover", scene, scene.at("radus")), undefined);
  await deactivate();
  console.log("the extension for VS Code: all is well");
}

/** Medians of 50 edits of a scene of 2000 lines, in milliseconds. */
async function times() {
  const lines = (count, line) => Array.from({ length: count }, (_, k) => line(k)).join("");
  const text = `Scene(\n    materials: {\n${lines(300, (k) => `        "m${k}": Diffuse(albedo: (0.${k % 10}, 0.5, 0.5)),\n`)}    },
    background: 1,\n    objects: [\n${lines(1693, (k) =>
      `        Sphere(center: (${k}, 0, ${k % 7}), radius: 0.5, material: "m${k % 300}"),\n`)}    ],\n)\n`;
  assert.equal(text.split("\n").length, 2001);
  let marked;
  const client = new Client(program, { told: () => marked?.(), ended: assert.fail });
  await client.initialize();
  const uri = "file:///nowhere/big.ron";
  client.tell("textDocument/didOpen", { textDocument: { uri, languageId: "ron", version: 0, text } });
  const spans = {};
  const time = async (name, answer) => {
    const start = performance.now();
    await answer();
    (spans[name] ??= []).push(performance.now() - start);
  };
  await new Promise((resolve) => setTimeout(resolve, 2000));
  for (let version = 1; version <= 50; version++) {
    const edited = text.replace("radius: 0.5", `radius: 0.${500 + version}`);
    const where = { textDocument: { uri }, position: { line: 1900, character: 40 } };
    await time("marks", () => new Promise((resolve) => {
      marked = resolve;
      client.tell("textDocument/didChange", { textDocument: { uri, version }, contentChanges: [{ text: edited }] });
    }));
    const document = { textDocument: { uri } };
    const name = { ...where, position: { line: 1900, character: edited.split("\n")[1900].indexOf("\"m") + 2 } };
    const range = { start: { line: 1900, character: 0 }, end: { line: 1900, character: 40 } };
    for (const [method, params] of [
      ["completion", where], ["hover", where], ["definition", name], ["references", { ...name, context: { includeDeclaration: true } }],
      ["documentHighlight", name], ["rename", { ...name, newName: "crimson" }], ["documentSymbol", document], ["documentColor", document],
      ["codeAction", { ...document, range, context: { diagnostics: [] } }], ["formatting", { ...document, options: { tabSize: 4, insertSpaces: true } }],
    ]) await time(method, () => client.ask(`textDocument/${method}`, params));
  }
  for (const [name, all] of Object.entries(spans)) {
    all.sort((a, b) => a - b);
    console.log(`${name}: median ${all[25].toFixed(1)} ms, least ${all[0].toFixed(1)} ms, most ${all[49].toFixed(1)} ms`);
  }
  await client.close();
}

const folder = mkdtempSync(join(tmpdir(), "editors-"));
(process.argv.includes("--times") ? times() : everything(folder)).finally(() => rmSync(folder, { recursive: true }));
