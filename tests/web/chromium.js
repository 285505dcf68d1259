// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// Chromium without a window, by the DevTools protocol through a pipe; and a server for the page.
'use strict';
const {spawn} = require('child_process');
const fs = require('fs'), http = require('http'), os = require('os'), path = require('path');

// Serves a folder; isolated: with the headers that allow threads.
function serve(folder, isolated) {
    const types = {'.html': 'text/html', '.js': 'text/javascript', '.gz': 'application/gzip'};
    const server = http.createServer((request, response) => {
        const name = path.basename(new URL(request.url, 'http://localhost').pathname), file = path.join(folder, name);
        if (!fs.existsSync(file) || !types[path.extname(name)]) {
            response.writeHead(404).end();
            return;
        }
        const headers = {'Content-Type': types[path.extname(name)]};
        if (isolated)
            Object.assign(headers, {'Cross-Origin-Opener-Policy': 'same-origin',
                                    'Cross-Origin-Embedder-Policy': 'require-corp'});
        response.writeHead(200, headers).end(fs.readFileSync(file));
    });
    return new Promise((done) => server.listen(0, '127.0.0.1', () =>
        done({url: `http://127.0.0.1:${server.address().port}`, close: () => server.close()})));
}

async function start() {
    const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'cgt-web-'));
    const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
        '--no-first-run', '--disable-background-networking', '--remote-debugging-pipe', '--window-size=960,640',
        `--user-data-dir=${profile}`, 'about:blank'], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    const waiting = new Map();
    let last = 0, text = '';
    browser.stdio[4].setEncoding('utf8').on('data', (piece) => {
        const parts = (text + piece).split('\0');
        text = parts.pop();
        for (const part of parts) {
            const message = JSON.parse(part), done = waiting.get(message.id);
            waiting.delete(message.id);
            if (done)
                message.error ? done.no(new Error(message.error.message)) : done.yes(message.result);
        }
    });
    browser.on('exit', () => waiting.forEach((done) => done.no(new Error('the browser has ended'))));
    const send = (method, params = {}, sessionId = undefined) => new Promise((yes, no) => {
        waiting.set(++last, {yes, no});
        browser.stdio[3].write(JSON.stringify({id: last, method, params, sessionId}) + '\0');
    });

    // A page: do(method, params), run(expression, which may be a promise).
    async function open(url) {
        const {targetId} = await send('Target.createTarget', {url: 'about:blank'});
        const {sessionId} = await send('Target.attachToTarget', {targetId, flatten: true});
        const page = {
            do: (method, params) => send(method, params, sessionId),
            async run(expression) {
                const {result, exceptionDetails} = await page.do('Runtime.evaluate',
                    {expression, awaitPromise: true, returnByValue: true});
                if (exceptionDetails)
                    throw new Error(exceptionDetails.exception.description || exceptionDetails.text);
                return result.value;
            },
            // Waits until an expression is true; the limit is for what hangs.
            async until(expression, seconds = 120) {
                for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
                    if (await page.run(`!!(${expression})`))
                        return;
                    await new Promise((done) => setTimeout(done, 20));
                }
                throw new Error(`never true: ${expression}; ${await page.run('JSON.stringify(window.cgtPage)')}`);
            },
            async screenshot(file) {
                const {data} = await page.do('Page.captureScreenshot', {format: 'png'});
                fs.writeFileSync(file, Buffer.from(data, 'base64'));
            },
            close: () => send('Target.closeTarget', {targetId}),
        };
        await page.do('Page.navigate', {url});
        await page.until('window.cgtPage');
        return page;
    }

    async function close() {
        const ended = new Promise((done) => browser.on('exit', done));
        send('Browser.close').catch(() => {});
        await ended;
        fs.rmSync(profile, {recursive: true, force: true, maxRetries: 10});
    }
    return {open, close};
}

module.exports = {serve, start};
