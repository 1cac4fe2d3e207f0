// Headless Chromium over its DevTools pipe: two file descriptors, messages ended by a zero byte. Needs Node 18 and nothing else.

import {spawn, spawnSync} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {readPng} from "./png.mjs";

// The browser's name, or null where there is none. CHROMIUM names another.
export function findBrowser() {
  for (const name of [process.env.CHROMIUM, "chromium", "chromium-browser", "google-chrome"])
    if (name && spawnSync(name, ["--version"], {stdio: "ignore", timeout: 30000}).status === 0) return name;
  return null;
}

export class Page {
  // A smaller scale makes a page that is drawn faster, since it has fewer pixels, if software draws.
  static async open(browser, url, {width = 1280, height = 800, scale = 1, flags = []} = {}) {
    const page = new Page();
    page.scale = scale;
    page.folder = mkdtempSync(join(tmpdir(), "tweenfall-page-"));
    page.child = spawn(browser, ["--headless", "--remote-debugging-pipe", "--no-sandbox", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking", "--disable-component-update",
      "--disable-sync", "--disable-quic", "--disable-extensions", "--force-device-scale-factor=1", "--hide-scrollbars",
      `--user-data-dir=${page.folder}`, `--window-size=${width},${height}`, ...flags, "about:blank"],
      {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
    page.next = 1;
    page.waiting = new Map();
    page.requests = [];
    page.problems = [];
    page.loaded = new Promise(resolve => { page.onLoad = resolve; });
    page.child.on("exit", () => {
      for (const {reject} of page.waiting.values()) reject(new Error("the browser ended"));
    });
    page.child.stdio[3].on("error", () => {});
    let rest = Buffer.alloc(0);
    page.child.stdio[4].on("data", data => {
      rest = Buffer.concat([rest, data]);
      for (let end; (end = rest.indexOf(0)) >= 0; rest = rest.subarray(end + 1))
        page.receive(JSON.parse(rest.subarray(0, end).toString()));
    });
    const {targetInfos} = await page.send("Target.getTargets");
    const {targetId} = targetInfos.find(target => target.type === "page");
    page.session = (await page.send("Target.attachToTarget", {targetId, flatten: true})).sessionId;
    for (const domain of ["Page", "Runtime", "Network"]) await page.send(domain + ".enable");
    await page.send("Emulation.setDeviceMetricsOverride", {width, height, deviceScaleFactor: scale, mobile: false});
    await page.send("Page.navigate", {url});
    await page.loaded;
    return page;
  }

  // Another address in the same window.
  async visit(url) {
    this.loaded = new Promise(resolve => { this.onLoad = resolve; });
    this.requests.length = this.problems.length = 0;
    await this.send("Page.navigate", {url});
    await this.loaded;
  }

  async resize(width, height) {
    await this.send("Emulation.setDeviceMetricsOverride", {width, height, deviceScaleFactor: this.scale, mobile: false});
    await this.until(`innerWidth === ${width} && innerHeight === ${height}`);
    await this.drawn();
  }

  receive(message) {
    if (message.id) {
      const {resolve, reject} = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    } else if (message.method === "Page.loadEventFired") {
      this.onLoad();
    } else if (message.method === "Network.requestWillBeSent") {
      this.requests.push(message.params.request.url);
    } else if (message.method === "Runtime.exceptionThrown") {
      const details = message.params.exceptionDetails;
      this.problems.push(details.exception?.description || details.text);
    } else if (message.method === "Runtime.consoleAPICalled" && message.params.type === "error") {
      this.problems.push(message.params.args.map(argument => argument.value).join(" "));
    }
  }

  send(method, params = {}) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      this.child.stdio[3].write(JSON.stringify({id, method, params, sessionId: this.session}) + "\0");
    });
  }

  // The value of an expression inside the page; promises are awaited.
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send("Runtime.evaluate",
      {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }

  // After two animation frames everything asked for is drawn.
  drawn() {
    return this.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
  }

  // Whether the expression becomes true within a generous time.
  async until(expression) {
    for (let tries = 0; tries < 200; ++tries) {
      if (await this.evaluate(expression)) return true;
      await new Promise(resolve => setTimeout(resolve, 100));
    }
    return false;
  }

  // What is on the screen, as PNG bytes.
  async screenshot() {
    return Buffer.from((await this.send("Page.captureScreenshot", {format: "png"})).data, "base64");
  }

  // The same as pixels, by places on the page.
  async picture() {
    return readPng(await this.screenshot(), this.scale);
  }

  async mouse(type, x, y, buttons = 0) {
    await this.send("Input.dispatchMouseEvent", {type, x, y, buttons, button: type === "mouseMoved" && !buttons ? "none" : "left",
      clickCount: type === "mouseMoved" ? 0 : 1});
  }

  async wheel(x, y, deltaY, deltaX = 0) {
    await this.send("Input.dispatchMouseEvent", {type: "mouseWheel", x, y, deltaX, deltaY});
    await this.drawn();
  }

  async type(text) {
    await this.send("Input.insertText", {text});
  }

  async drag(x0, y0, x1, y1) {
    await this.mouse("mousePressed", x0, y0, 1);
    for (let i = 1; i <= 4; ++i) await this.mouse("mouseMoved", x0 + (x1 - x0) * i / 4, y0 + (y1 - y0) * i / 4, 1);
    await this.mouse("mouseReleased", x1, y1);
  }

  async click(x, y) {
    await this.drag(x, y, x, y);
  }

  // `modifiers`: 8 for shift, 1 for alt.
  async key(key, modifiers = 0) {
    const text = key === " " ? {text: " "} : {};
    await this.send("Input.dispatchKeyEvent", {type: "keyDown", key, modifiers, ...text});
    await this.send("Input.dispatchKeyEvent", {type: "keyUp", key, modifiers});
  }

  async close() {
    const ended = new Promise(resolve => this.child.once("exit", resolve));
    await this.send("Browser.close").catch(() => {});
    const late = setTimeout(() => this.child.kill("SIGKILL"), 5000);
    await ended;
    clearTimeout(late);
    rmSync(this.folder, {recursive: true, force: true, maxRetries: 5});
  }
}
