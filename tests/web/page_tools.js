// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// What tests of the page share: tests that are counted, files that are dropped, fingers and keys, pixels, contrast.
'use strict';
const assert = require('assert'), fs = require('fs'), path = require('path');
const {execFileSync} = require('child_process');

const [, render] = process.argv.slice(2), only = new RegExp(process.argv[6] || '');
const data = path.join(__dirname, '../../examples/data');
const read = (name) => fs.readFileSync(path.join(data, name));
const width = 320, height = 200;
const count = {failed: 0};

async function test(name, body) {
    if (!only.test(name))
        return;
    try {
        const more = await body();
        console.log(`passed: ${name}${more ? ': ' + more : ''}`);
    } catch (error) {
        count.failed++;
        console.log(`FAILED: ${name}: ${error.stack}`);
    }
}

// Drops files on the page, by names and bytes in turns, and waits for their picture or their error.
async function drop(page, ...files) {
    const rows = [];
    for (let i = 0; i < files.length; i += 2)
        rows.push([files[i], Buffer.from(files[i + 1]).toString('base64')]);
    await expect(page, () => page.run(`(() => {
        const files = new DataTransfer();
        for (const [name, text] of ${JSON.stringify(rows)})
            files.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
        dispatchEvent(new DragEvent('drop', {dataTransfer: files}));
    })()`));
}
// Does what opens files, and waits for their picture or their error.
async function expect(page, open) {
    await page.run(`(() => { cgtPage.opened = cgtPage.error = ''; cgtPage.pictures = 0; })()`);
    await open();
    await page.until(`(cgtPage.opened && cgtPage.pictures) || cgtPage.error`);
}
async function settle(page) { // no event is on its way, and the picture is complete
    await page.run(`cgtPage.ask('camera')`);
    await page.run(`new Promise((done) => setTimeout(done, 50))`);
    await page.until(`cgtPage.left === 0`);
}
const camera = (page) => page.run(`cgtPage.ask('camera').then((m) => m.text)`);
async function pixels(page) {
    const text = await page.run(`(() => {
        const p = document.getElementById('picture');
        const d = p.getContext('2d').getImageData(0, 0, p.width, p.height).data;
        let text = '';
        for (let i = 0; i < d.length; i += 4)
            text += String.fromCharCode(d[i], d[i + 1], d[i + 2]);
        return btoa(text);
    })()`);
    return Buffer.from(text, 'base64');
}
async function compare(page, file, style, frame = 0, options = []) {
    await settle(page);
    const native = execFileSync(render, ['-c', await camera(page), '-s', `${width}x${height}`, '--style', style,
        '-o', '-', '--first', frame, '--last', frame, ...options, file].map(String),
        {maxBuffer: 1 << 26, stdio: ['ignore', 'pipe', 'ignore']});
    const page_bytes = await pixels(page);
    assert.strictEqual(page_bytes.length, native.length);
    let differ = 0;
    for (let i = 0; i < native.length; i++)
        differ += native[i] !== page_bytes[i];
    assert(new Set(native).size > 20, 'the picture is empty');
    assert.strictEqual(differ, 0, `${differ} of ${native.length} bytes differ`);
}
async function mouse(page, type, x, y, buttons = 1) {
    await page.do('Input.dispatchMouseEvent', {type, x, y, button: 'left', buttons, clickCount: 1});
}
async function drag(page, from, to) {
    await mouse(page, 'mousePressed', ...from);
    for (let i = 1; i <= 4; i++)
        await mouse(page, 'mouseMoved', ...from.map((x, c) => x + (to[c] - x) * i / 4));
    await mouse(page, 'mouseReleased', ...to, 0);
}
const style = (page, name) => page.run(`(() => { const s = document.getElementById('style'); s.value = '${name}';
    cgtPage.left = -1; s.onchange(); })()`);

async function key(page, key, code, modifiers = 0) {
    for (const type of ['keyDown', 'keyUp'])
        await page.do('Input.dispatchKeyEvent', {type, key, modifiers, windowsVirtualKeyCode: code,
            ...(type === 'keyDown' && key.length === 1 && !modifiers ? {text: key} : {}),
            ...(type === 'keyDown' && key === 'Enter' ? {text: '\r'} : {})});
}
// The field of an option's value.
const entryOf = (name) =>
    `document.querySelector('[data-option="${name}"]').querySelector('textarea, input:not([type=checkbox])')`;
// Types an option's value as a user does, or presses its checkbox; waits for the engine's answer and the picture.
async function edit(page, name, value) {
    await page.run(`cgtPage.left = -1`);
    if (value === undefined) {
        await page.run(`document.getElementById('option-${name}').click()`);
    } else {
        await page.run(`(() => {
            const e = ${entryOf(name)};
            e.closest('details').open = true;
            e.focus();
            e.select();
        })()`);
        await page.do('Input.insertText', {text: value});
        await page.run(`document.activeElement.blur()`);
    }
    await settle(page);
}
// The least contrast of all texts that are shown to what is behind them, as WCAG 2 has it.
const contrast = (page) => page.run(`(() => {
    const parse = (c) => c.match(/[\\d.]+/g).map(Number);
    const light = (c) => c.slice(0, 3).map((v) => v / 255)
        .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const behind = (e) => {
        const c = parse(getComputedStyle(e).backgroundColor);
        return c[3] === 0 ? behind(e.parentElement) : c;
    };
    const texts = 'body :is(label, summary, button, p, input, select, textarea, h2, h3, th, td, li, span, output)';
    return Math.min(...[...document.querySelectorAll(texts)]
        .filter((e) => e.offsetParent && !e.disabled && !/^(range|checkbox|radio|color|file)$/.test(e.type))
        .map((e) => [light(parse(getComputedStyle(e).color)), light(behind(e))].sort((a, b) => b - a))
        .map(([a, b]) => (a + 0.05) / (b + 0.05)));
})()`);


module.exports = {test, count, read, expect, settle, camera, pixels, compare, mouse, drag, style, drop, key, entryOf,
    edit, contrast, width, height, data};
