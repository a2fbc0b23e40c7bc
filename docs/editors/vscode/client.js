// A client of the Language Server Protocol over a program's standard input and output. It knows no editor.
"use strict";

const { spawn } = require("node:child_process");

/** The error of a request that the server refused; its message is a sentence for people. */
class Refused extends Error {}

class Client {
  /**
   * Starts a server.
   * @param {string} program its name or path
   * @param {{ told?: (method: string, params: any) => void, ended?: (why: string) => void }} listener
   */
  constructor(program, listener = {}) {
    this.listener = listener;
    this.waiting = new Map();
    this.next = 0;
    this.received = Buffer.alloc(0);
    this.isClosed = false;
    this.process = spawn(program, ["lsp"], { stdio: ["pipe", "pipe", "ignore"] });
    this.process.stdout.on("data", (bytes) => this.take(bytes));
    // A server that has died is told by its end.
    this.process.stdin.on("error", () => {});
    this.process.on("error", (error) => this.end(`cannot start ${program}: ${error.message}`));
    this.process.on("exit", (code, signal) => this.end(`${program} lsp has ended (${signal ?? `exit code ${code}`})`));
  }

  /** Says hello; gives what the server can do. */
  async initialize() {
    const capabilities = { textDocument: { completion: { completionItem: { snippetSupport: true } } } };
    const answer = await this.ask("initialize", { processId: process.pid, rootUri: null, capabilities });
    this.tell("initialized", {});
    return answer.capabilities;
  }

  /** Asks; the promise fails where the server refuses or has ended. */
  ask(method, params) {
    if (this.isClosed) return Promise.reject(new Error("the language server does not run"));
    const id = ++this.next;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.send({ id, method, params });
    });
  }

  tell(method, params) {
    if (!this.isClosed) this.send({ method, params });
  }

  /** Says goodbye. */
  async close() {
    if (this.isClosed) return;
    const { listener } = this;
    this.listener = { ...listener, ended: undefined };
    await this.ask("shutdown", null).catch(() => {});
    this.tell("exit", null);
    this.process.stdin.end();
  }

  send(message) {
    const body = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }));
    this.process.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
    this.process.stdin.write(body);
  }

  take(bytes) {
    this.received = Buffer.concat([this.received, bytes]);
    for (;;) {
      const end = this.received.indexOf("\r\n\r\n");
      if (end < 0) return;
      const length = Number(/content-length: *(\d+)/i.exec(this.received.toString("latin1", 0, end))?.[1]);
      const from = end + 4;
      if (this.received.length < from + length) return;
      const message = JSON.parse(this.received.toString("utf8", from, from + length));
      this.received = this.received.subarray(from + length);
      this.handle(message);
    }
  }

  handle({ id, method, params, result, error }) {
    if (method !== undefined) {
      // The server asks nothing of editors.
      if (id === undefined) this.listener.told?.(method, params);
      return;
    }
    const asked = this.waiting.get(id);
    this.waiting.delete(id);
    if (error) asked?.reject(new Refused(error.message));
    else asked?.resolve(result);
  }

  end(why) {
    if (this.isClosed) return;
    this.isClosed = true;
    for (const asked of this.waiting.values()) asked.reject(new Error(why));
    this.waiting.clear();
    this.listener.ended?.(why);
  }
}

module.exports = { Client, Refused };
