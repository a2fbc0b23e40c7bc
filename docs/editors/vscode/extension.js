// Scenes of tracer in VS Code: what `tracer lsp` tells and answers. The server says which files of TOML and JSON are scenes.
"use strict";

const vscode = require("vscode");
const { Client, Refused } = require("./client.js");

const files = (name) => [{ language: name }, { pattern: `**/*.${name}` }];
const SCENES = ["ron", "toml", "json"].flatMap(files);
const isOurs = (document) => vscode.languages.match(SCENES, document) > 0;

let client;
let marks;

// From places of the protocol to those of the editor, and back: both count in units of UTF-16.
const position = ({ line, character }) => new vscode.Position(line, character);
const range = ({ start, end }) => new vscode.Range(position(start), position(end));
const edit = ({ range: place, newText }) => new vscode.TextEdit(range(place), newText);
const place = ({ line, character }) => ({ line, character });
const extent = ({ start, end }) => ({ start: place(start), end: place(end) });
const named = (document) => ({ textDocument: { uri: document.uri.toString() } });
const at = (document, where) => ({ ...named(document), position: place(where) });

function workspaceEdit({ changes }) {
  const all = new vscode.WorkspaceEdit();
  for (const [uri, edits] of Object.entries(changes)) all.set(vscode.Uri.parse(uri), edits.map(edit));
  return all;
}

function diagnostic(told) {
  const mark = new vscode.Diagnostic(range(told.range), told.message, told.severity - 1);
  mark.source = told.source;
  mark.code = told.code;
  mark.relatedInformation = told.relatedInformation?.map(
    ({ location, message }) =>
      new vscode.DiagnosticRelatedInformation(new vscode.Location(vscode.Uri.parse(location.uri), range(location.range)), message),
  );
  return mark;
}

function completionItem(told) {
  const item = new vscode.CompletionItem(told.label, told.kind - 1);
  item.detail = told.detail;
  if (told.documentation) item.documentation = new vscode.MarkdownString(told.documentation.value);
  item.sortText = told.sortText;
  const { newText } = told.textEdit;
  item.insertText = told.insertTextFormat === 2 ? new vscode.SnippetString(newText) : newText;
  item.range = range(told.textEdit.range);
  return item;
}

function symbol(told) {
  const made = new vscode.DocumentSymbol(
    told.name, told.detail ?? "", told.kind - 1, range(told.range), range(told.selectionRange));
  made.children = (told.children ?? []).map(symbol);
  return made;
}

/** What the server answers; nothing where it refuses or does not run: then that has been told. */
async function asked(method, params) {
  try {
    return await client?.ask(method, params);
  } catch (error) {
    if (error instanceof Refused) throw error;
    return undefined;
  }
}

const locations = async (method, document, where, more) => {
  const answer = await asked(method, { ...at(document, where), ...more });
  const all = answer ? [answer].flat() : [];
  return all.map(({ uri, range: found }) => new vscode.Location(vscode.Uri.parse(uri), range(found)));
};

/** What the editor asks, by the name of the function that registers it. */
const PROVIDERS = {
  registerHoverProvider: {
    async provideHover(document, where) {
      const answer = await asked("textDocument/hover", at(document, where));
      return answer && new vscode.Hover(new vscode.MarkdownString(answer.contents.value), range(answer.range));
    },
  },
  registerDefinitionProvider: {
    provideDefinition: (document, where) => locations("textDocument/definition", document, where),
  },
  registerReferenceProvider: {
    provideReferences: (document, where) =>
      locations("textDocument/references", document, where, { context: { includeDeclaration: true } }),
  },
  registerDocumentHighlightProvider: {
    async provideDocumentHighlights(document, where) {
      const answer = await asked("textDocument/documentHighlight", at(document, where));
      return (answer ?? []).map((found) => new vscode.DocumentHighlight(range(found.range)));
    },
  },
  registerRenameProvider: {
    async prepareRename(document, where) {
      const answer = await asked("textDocument/prepareRename", at(document, where));
      if (!answer) throw new Error("Here is no name that can be changed.");
      return range(answer);
    },
    async provideRenameEdits(document, where, newName) {
      const answer = await asked("textDocument/rename", { ...at(document, where), newName });
      return answer && workspaceEdit(answer);
    },
  },
  registerDocumentSymbolProvider: {
    async provideDocumentSymbols(document) {
      return ((await asked("textDocument/documentSymbol", named(document))) ?? []).map(symbol);
    },
  },
  registerColorProvider: {
    async provideDocumentColors(document) {
      const answer = await asked("textDocument/documentColor", named(document));
      return (answer ?? []).map(({ range: found, color: { red, green, blue, alpha } }) =>
        new vscode.ColorInformation(range(found), new vscode.Color(red, green, blue, alpha)));
    },
    async provideColorPresentations({ red, green, blue, alpha }, { document, range: where }) {
      const params = { ...named(document), color: { red, green, blue, alpha }, range: extent(where) };
      const answer = await asked("textDocument/colorPresentation", params);
      return (answer ?? []).map((told) => {
        const made = new vscode.ColorPresentation(told.label);
        made.textEdit = edit(told.textEdit);
        return made;
      });
    },
  },
  registerCodeActionsProvider: {
    async provideCodeActions(document, where) {
      const params = { ...named(document), range: extent(where), context: { diagnostics: [] } };
      const answer = await asked("textDocument/codeAction", params);
      return (answer ?? []).map((told) => {
        const action = new vscode.CodeAction(told.title, vscode.CodeActionKind.QuickFix);
        action.edit = workspaceEdit(told.edit);
        action.diagnostics = told.diagnostics?.map(diagnostic);
        action.isPreferred = told.isPreferred;
        return action;
      });
    },
  },
};

const laidOut = async (document, { tabSize, insertSpaces }) => {
  const params = { ...named(document), options: { tabSize, insertSpaces } };
  return ((await asked("textDocument/formatting", params)) ?? []).map(edit);
};

// For RON alone: of two for TOML or JSON the editor would ask everybody which to take. There is a command for those.
const LAYOUT = { provideDocumentFormattingEdits: laidOut };

async function format() {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || !isOurs(document)) return;
  const all = new vscode.WorkspaceEdit();
  all.set(document.uri, await laidOut(document, { tabSize: 4, insertSpaces: true }));
  await vscode.workspace.applyEdit(all);
}

const COMPLETION = {
  async provideCompletionItems(document, where) {
    return ((await asked("textDocument/completion", at(document, where))) ?? []).map(completionItem);
  },
};

function opened(document) {
  if (!isOurs(document)) return;
  const { languageId, version } = document;
  const item = { uri: document.uri.toString(), languageId, version, text: document.getText() };
  client?.tell("textDocument/didOpen", { textDocument: item });
}

function changed({ document, contentChanges }) {
  if (!isOurs(document) || contentChanges.length === 0) return;
  const item = { uri: document.uri.toString(), version: document.version };
  client?.tell("textDocument/didChange", { textDocument: item, contentChanges: [{ text: document.getText() }] });
}

function told(method, params) {
  if (method === "textDocument/publishDiagnostics") {
    marks.set(vscode.Uri.parse(params.uri), params.diagnostics.map(diagnostic));
  }
}

/** Starts the server, in place of one that runs; gives what it can do. */
async function start() {
  await client?.close();
  marks.clear();
  const program = vscode.workspace.getConfiguration("tracer").get("path", "tracer");
  const ended = (why) => vscode.window.showErrorMessage(`${why}. The setting tracer.path tells where the program is.`);
  client = new Client(program, { told, ended });
  const capabilities = await client.initialize().catch(() => undefined);
  vscode.workspace.textDocuments.forEach(opened);
  return capabilities;
}

function preview() {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || !isOurs(document)) return;
  const program = vscode.workspace.getConfiguration("tracer").get("path", "tracer");
  // Without a shell between: a file's name may have any letters.
  vscode.window.createTerminal({ name: "tracer preview", shellPath: program, shellArgs: ["preview", document.fileName] }).show();
}

async function activate(context) {
  marks = vscode.languages.createDiagnosticCollection("tracer");
  context.subscriptions.push(
    marks,
    vscode.workspace.onDidOpenTextDocument(opened),
    vscode.workspace.onDidChangeTextDocument(changed),
    vscode.workspace.onDidSaveTextDocument((document) => {
      if (isOurs(document)) client?.tell("textDocument/didSave", named(document));
    }),
    vscode.workspace.onDidCloseTextDocument((document) => {
      if (isOurs(document)) client?.tell("textDocument/didClose", named(document));
    }),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("tracer.path")) return start();
    }),
    vscode.commands.registerCommand("tracer.restart", start),
    vscode.commands.registerCommand("tracer.format", format),
    vscode.commands.registerCommand("tracer.preview", preview),
    vscode.languages.registerDocumentFormattingEditProvider(files("ron"), LAYOUT),
  );
  const capabilities = await start();
  for (const [register, provider] of Object.entries(PROVIDERS)) {
    context.subscriptions.push(vscode.languages[register](SCENES, provider));
  }
  const triggers = capabilities?.completionProvider?.triggerCharacters ?? [];
  context.subscriptions.push(vscode.languages.registerCompletionItemProvider(SCENES, COMPLETION, ...triggers));
}

const deactivate = () => client?.close();

module.exports = { activate, deactivate };
