// A page of static files in a browser without a window, for tests.

import { mkdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
                   "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   "--autoplay-policy=no-user-gesture-required"];

async function serve(folder) {
    const server = createServer((request, response) => {
        const path = new URL(request.url, "http://x").pathname.replace(/\/$/, "/index.html");
        try {
            const body = readFileSync(join(folder, path));
            response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "application/octet-stream" }).end(body);
        } catch {
            response.writeHead(404).end();
        }
    }).listen(0, "127.0.0.1");
    await new Promise((done) => server.once("listening", done));
    return server;
}

/** page, pictures: folders. errors: what the pages of this browser complained of. */
export async function openBrowser(page, playwright, pictures, executablePath) {
    const { chromium } = (await import(pathToFileURL(resolve(playwright)))).default;
    const server = await serve(page), browser = await chromium.launch({ executablePath, args: ARGUMENTS }), errors = [];
    const address = `http://127.0.0.1:${server.address().port}/`;
    mkdirSync(pictures, { recursive: true });
    return {
        errors,
        /** A tab, when the page says that it is ready. first: a function that runs in it before the page's own. */
        async open(where = "?still&free", options = { viewport: { width: 1000, height: 640 } }, first = () => {}) {
            const context = await browser.newContext(options), tab = await context.newPage();
            await tab.addInitScript(first);
            tab.on("pageerror", (error) => errors.push(`${error.message} ${error.stack}`));
            tab.on("console", (message) => message.type() === "error" && errors.push(message.text()));
            await tab.goto(address + where);
            await tab.waitForFunction(() => globalThis.game?.opened, null, { timeout: 60000 });
            return tab;
        },
        picture: (tab, name) => tab.screenshot({ path: join(pictures, `${name}.png`), timeout: 120000 }),
        async close() {
            await browser.close();
            server.close();
        },
    };
}
