// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// What the page tells of what is clicked, tapped or selected. Called by test_page.js.
'use strict';
const assert = require('assert'), path = require('path');
const {test, read, settle, camera, pixels, drop, key, style, compare, contrast, data} = require('./page_tools.js');

// The whole window is the picture: places are pixels.
async function openAt(browser, address, [across, down], isTouched) {
    const page = await browser.open(address.replace(/size=[^&]*&/, ''));
    await page.do('Emulation.setDeviceMetricsOverride',
        {width: across, height: down, deviceScaleFactor: 1, mobile: isTouched});
    await page.do('Emulation.setTouchEmulationEnabled', {enabled: isTouched});
    return page;
}

async function press(page, [x, y], isTouched) {
    if (isTouched) {
        await page.do('Input.dispatchTouchEvent', {type: 'touchStart', touchPoints: [{x, y, id: 1}]});
        await page.do('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
    } else {
        for (const type of ['mousePressed', 'mouseReleased'])
            await page.do('Input.dispatchMouseEvent', {type, x, y, button: 'left', clickCount: 1});
    }
    await page.run(`cgtPage.ask('camera')`); // the engine has answered
}

// Places of the window that show certain primitives, found by asking for a grid of them; 'bond': none of the data's.
async function find(page, wanted) {
    const found = new Map(), [across, down] = await page.run(`[picture.width, picture.height]`);
    for (let y = 12; y < down; y += 6)
        for (let x = 12; x < across && found.size < wanted.length; x += 6) {
            const id = await page.run(`cgtPage.ask('pick', {x: ${x}, y: ${y}}, 'picked').then((m) => m.id)`);
            if (wanted.includes(id) && !found.has(id))
                found.set(id, [x, y]);
        }
    return wanted.map((id) => found.get(id));
}
const card = (page) => page.run(`(() => {
    const card = document.getElementById('card');
    return {shown: !card.hidden, title: document.getElementById('card-title').textContent,
        measures: [...document.querySelectorAll('#measures li')].map((e) => e.textContent),
        names: [...document.querySelectorAll('#picks summary')].map((e) => e.textContent),
        rows: Object.fromEntries([...document.querySelectorAll('#picks details[open] tr')]
            .map((e) => [e.children[0].textContent, e.children[1].textContent])),
        marks: [...document.querySelectorAll('#marks .mark:not([hidden])')].map((e) => {
            const b = e.getBoundingClientRect();
            return [b.left + b.width / 2, b.top + b.height / 2];
        })};
})()`);

// Caffeine with some columns of its own: words, whole numbers, fractions.
function molecule() {
    const lines = read('caffeine.xyz').toString().trim().split('\n'), rows = lines.slice(2);
    lines[1] = 'Lattice="30 0 0 0 30 0 0 0 30" pbc="T T T" Properties=species:S:1:pos:R:3:resname:S:1:charge:R:1:group:I:1';
    return {places: rows.map((row) => row.trim().split(/\s+/).slice(1, 4).map(Number)),
            elements: rows.map((row) => row.trim().split(/\s+/)[0]),
            text: [...lines.slice(0, 2), ...rows.map((row, k) => `${row} ${k % 2 ? 'ODD' : 'CAF'} ${k / 8} ${k % 3}`)]
                .join('\n') + '\n'};
}
const minus = (a, b) => a.map((x, c) => x - b[c]), dot = (a, b) => a.reduce((sum, x, c) => sum + x * b[c], 0);
const cross = (a, b) => [0, 1, 2].map((c) => a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]);
const degrees = 180 / Math.PI;
function measureByHand(p) {
    const [a, b, c] = [1, 2, 3].map((k) => p[k] && minus(p[k], p[k - 1]));
    if (p.length === 2)
        return Math.sqrt(dot(a, a));
    if (p.length === 3)
        return degrees * Math.acos(-dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b)));
    const n = cross(a, b), m = cross(b, c);
    return degrees * Math.sign(dot(a, m)) * Math.acos(dot(n, m) / Math.sqrt(dot(n, n) * dot(m, m)));
}

async function testPicks(browser, address, size, isTouched, out) {
    const page = await openAt(browser, address, size, isTouched), name = `ask, ${size[0]} pixels wide`;
    const mol = molecule(), few = [0, 1, 5, 9];
    await drop(page, 'molecule.xyz', mol.text);
    await style(page, 'plain');
    await page.run(`cgtPage.ask('put', {name: 'radius-scale', values: '0.3\\n'}).then(() =>
        cgtPage.ask('put', {name: 'bonds', values: '\\n'}))`);
    await page.run(`cgtPage.ask('put', {name: 'view', values: '0.3,0.2,1\\n'})`);
    await settle(page);
    const places = await find(page, few);
    await test(`${name}: what is pressed tells all that is known of it`, async () => {
        assert(places.every((p) => p), JSON.stringify(places));
        await press(page, places[1], isTouched);
        const shown = await card(page);
        assert(shown.shown);
        assert.strictEqual(shown.title, 'Picked');
        assert.match(shown.names[0], new RegExp(`^1sphere 1, .*${mol.elements[1]}$`));
        assert.strictEqual(shown.rows.resname, 'ODD');
        assert.strictEqual(shown.rows.charge, '0.125');
        assert.strictEqual(shown.rows.group, '1');
        assert(shown.rows.at && shown.rows.radius);
        const columns = await page.run(`cgtPage.columns`), own = ['id', 'type', 'x', 'y', 'z', 'radius']; // in other lines
        for (const column of columns.filter((name) => !own.includes(name)))
            assert(column in shown.rows, `${column} is not told`);
        const told = await page.run(`cgtPage.ask('describe', {element: 1}, 'described').then((m) => m.text)`);
        assert.strictEqual(Object.keys(shown.rows).length, told.trim().split('\n').length - 1);
        assert(Math.hypot(...minus(shown.marks[0], places[1])) < 40, 'the mark is far from the atom');
        await page.screenshot(path.join(out, `ask_${size[0]}.png`));
        const [left, right, wide] = await page.run(`(() => { const b = card.getBoundingClientRect();
            return [b.left, b.right, document.documentElement.scrollWidth]; })()`);
        assert(left >= 0 && right <= size[0] && wide <= size[0], `${left}, ${right}, ${wide}`);
        assert(await contrast(page) >= 4.5, `contrast ${await contrast(page)}`);
        await key(page, 'Escape', 27);
        await page.until(`card.hidden`, 5);
        assert.deepStrictEqual((await card(page)).marks, []);
    });
    await test(`${name}: distance, angle and dihedral`, async () => {
        for (const place of places)
            await page.run(`cgtPage.ask('ask', {x: ${place[0]}, y: ${place[1]}}, 'asked')`);
        const shown = await card(page), numbers = shown.measures.map((text) => parseFloat(text.split(': ')[1]));
        const sets = [[0, 1], [1, 2], [2, 3], [0, 1, 2], [1, 2, 3], [0, 1, 2, 3]];
        assert.strictEqual(numbers.length, sets.length);
        sets.forEach((set, k) => {
            const right = measureByHand(set.map((i) => mol.places[few[i]]));
            assert(Math.abs(numbers[k] - right) < 1e-4 * Math.max(1, Math.abs(right)), `${shown.measures[k]}, not ${right}`);
        });
        assert(shown.measures[0].startsWith('distance 1\u20132: ') && shown.measures[5].startsWith('dihedral 1\u20132\u20133\u20134: '));
        assert.strictEqual(shown.marks.length, 4);
        await page.screenshot(path.join(out, `dihedral_${size[0]}.png`));
        await page.run(`cgtPage.ask('ask', {x: ${places[3][0]}, y: ${places[3][1]}}, 'asked')`); // taken back
        assert.strictEqual((await card(page)).measures.length, 3);
        await page.run(`document.getElementById('card-close').click()`);
        await page.until(`card.hidden`, 5);
    });
    await test(`${name}: a bond is its two ends`, async () => {
        let shown;
        for (let share = 0.35; share < 0.66; share += 0.05) { // on the line between the first two, which are bonded
            await page.run(`cgtPage.ask('forgetPicks', {}, 'asked')`);
            await press(page, [0, 1].map((c) => Math.round(places[0][c] * (1 - share) + places[1][c] * share)), isTouched);
            shown = await card(page);
            if (shown.title === 'Bond')
                break;
        }
        assert.strictEqual(shown.title, 'Bond', 'no bond was hit');
        assert.match(shown.measures[0], /^length 1\u20132: 1\.\d+$/);
        assert.strictEqual(shown.names.length, 2);
        await page.run(`cgtPage.ask('forgetPicks', {}, 'asked')`);
    });
    await page.close();
}

async function testSelections(browser, address, out) {
    const page = await browser.open(address), file = path.join(data, 'caffeine.xyz');
    const type = async (text) => {
        await page.run(`(() => { const e = document.getElementById('filter'); e.focus(); e.select(); })()`);
        await page.do('Input.insertText', {text});
        await page.run(`new Promise((done) => setTimeout(done, 300)).then(() => cgtPage.ask('camera'))`);
    };
    const state = () => page.run(`({count: document.getElementById('selected').textContent,
        refused: document.getElementById('filter-refused').textContent,
        shown: !document.getElementById('filter-refused').hidden,
        invalid: document.getElementById('filter').getAttribute('aria-invalid'),
        enabled: [...document.querySelectorAll('#select .buttons button:enabled:not([hidden])')].map((e) => e.id)})`);
    const push = async (id) => {
        await page.run(`cgtPage.left = -1, document.getElementById('${id}').click()`);
        await settle(page);
    };
    await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
    await style(page, 'plain');
    await settle(page);
    await test('a formula selects, and says how many or why not', async () => {
        await key(page, 'a', 65);
        await type('element == C');
        let now = await state();
        assert.deepStrictEqual([now.count, now.refused, now.shown], ['8 of 24 selected', '', false]);
        assert.deepStrictEqual(now.enabled, ['hide', 'isolate', 'fade', 'label', 'follow', 'show-all']);
        await page.screenshot(path.join(out, 'selection.png'));
        for (const [text, says] of [['element == ', /formula|ends|expected/i], ['chargee > 1', /no column "chargee"/]]) {
            await type(text);
            now = await state();
            assert.match(now.refused, says);
            assert.deepStrictEqual([now.count, now.shown, now.invalid, now.enabled], ['', true, 'true', ['show-all']]);
        }
        await page.screenshot(path.join(out, 'selection_refused.png'));
        assert(await contrast(page) >= 4.5, `contrast ${await contrast(page)}`);
        await type('x > 1e9');
        now = await state();
        assert.deepStrictEqual([now.count, now.shown, now.enabled], ['0 of 24 selected', false, ['show-all']]);
    });
    await test('what is selected is hidden, shown alone, faded and labelled, as cgt-render does', async () => {
        await type('element == H');
        const all = await pixels(page);
        for (const [id, option] of [['hide', '--hide=element == H'], ['isolate', '--show=element == H'],
                                    ['fade', '--opacity=not (element == H)=0.15'], ['label', '--label=element == H']]) {
            await push(id);
            await compare(page, file, 'plain', 0, [option]);
            await push('show-all');
            assert(Buffer.compare(all, await pixels(page)) === 0, `${id} is not taken back`);
        }
        await type('type'); // a formula, and no name of a type
        await push('isolate');
        await compare(page, file, 'plain');
        await push('show-all');
        await type('element == H');
        await push('hide');
        await page.run(`cgtPage.left = -1, document.activeElement.blur()`);
        await key(page, 'u', 85); // one change, which is undone
        await settle(page);
        assert(Buffer.compare(all, await pixels(page)) === 0, 'hide is not undone');
    });
    await test('what was picked is selected, and what is like it', async () => {
        const [place] = await find(page, [3]);
        await page.run(`cgtPage.ask('ask', {x: ${place[0]}, y: ${place[1]}}, 'asked')`);
        await page.run(`document.getElementById('card-select').click(); cgtPage.ask('camera')`);
        assert.strictEqual(await page.run(`document.getElementById('filter').value`), 'index == 3');
        assert.strictEqual((await state()).count, '1 of 24 selected');
        await drop(page, 'molecule.xyz', molecule().text);
        await page.run(`cgtPage.ask('ask', {x: ${place[0]}, y: ${place[1]}}, 'asked')`);
        await page.run(`document.querySelector('#picks [title^="Select all with resname"]').click(); cgtPage.ask('camera')`);
        assert.match(await page.run(`document.getElementById('filter').value`), /^resname == "(ODD|CAF)"$/);
        assert.strictEqual((await state()).count, '12 of 24 selected');
    });
    await test('what is followed stays where it is in the picture', async () => {
        const at = (x, k) => `3\nframe ${k}\nC ${x} 0 0\nO ${x + 1} 2 0\nC -4 -4 ${k}\n`;
        await drop(page, 'run.xyz', at(0, 0) + at(3, 1) + at(-2, 2));
        await type('x > -4 and index < 2');
        await page.run(`cgtPage.ask('follow', {formula: 'index < 2'})`);
        const eye = async () => (await camera(page)).split(',').map(Number), before = await eye();
        for (const [frame, x] of [[1, 3], [2, -2], [0, 0]]) {
            await page.run(`cgtPage.ask('seek', {frame: ${frame}}, 'picture')`);
            await settle(page);
            const now = await eye();
            [x, 0, 0, x, 0, 0].forEach((step, c) => assert(Math.abs(now[c] - before[c] - step) < 1e-4, `${now} ${before}`));
        }
        await page.run(`document.getElementById('follow').click(); cgtPage.ask('camera')`);
        assert.strictEqual(await page.run(`document.getElementById('follow').getAttribute('aria-pressed')`), 'false');
        await page.run(`cgtPage.ask('seek', {frame: 1}, 'picture')`);
        assert((await eye()).every((x, c) => Math.abs(x - before[c]) < 1e-4), 'it is followed still');
        assert.match(await page.run(`cgtPage.ask('follow', {formula: 'x > 99'}).then((m) => m.text)`), /selects nothing/);
        await page.run(`cgtPage.ask('follow', {formula: 'index < 2'})`); // in frame 1: what is read stays
        await page.run(`cgtPage.ask('load', {name: 'a.settings', text: 'camera = 1,2,30,1,2,0,0,1,0,30'}, 'loaded')`);
        assert.strictEqual(await camera(page), '1,2,30,1,2,0,0,1,0,30');
    });
    await test('picks go with their ids, and triangles have places', async () => {
        const of = (rows) => 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n' + rows.length + '\nITEM: BOX BOUNDS pp pp pp\n' +
            '-9 9\n-9 9\n-9 9\nITEM: ATOMS id type x y z\n' + rows.map((row) => row.join(' ') + '\n').join('');
        await drop(page, 'run.lammpstrj', of([[1, 1, -2, 0, 0], [2, 1, 2, 0, 0]]) + of([[2, 1, 3, 0, 0], [1, 1, -1, 0, 0]]) +
            of([[1, 1, -1, 0, 0]]));
        const [a, b] = await find(page, [0, 1]);
        for (const place of [a, b])
            await page.run(`cgtPage.ask('ask', {x: ${place[0]}, y: ${place[1]}}, 'asked')`);
        assert.deepStrictEqual((await card(page)).measures, ['distance 1\u20132: 4']);
        await page.run(`cgtPage.ask('seek', {frame: 1}, 'asked')`);
        assert.deepStrictEqual((await card(page)).measures, ['distance 1\u20132: 4']);
        assert.match((await card(page)).names[0], /sphere 1, id 1/);
        await page.run(`cgtPage.ask('seek', {frame: 2}, 'asked')`);
        assert.deepStrictEqual((await card(page)).names.map((text) => text.slice(1)),
            ['sphere 0, id 1, type 1', 'id 2 is not in this frame']);
        const xyz = (count) => `${count}\n\n` + [-2, 0, 2].slice(0, count).map((x) => `C ${x} 0 0\n`).join('');
        await drop(page, 'run.xyz', xyz(3) + xyz(2)); // without ids
        const [last] = await find(page, [2]);
        await page.run(`cgtPage.ask('ask', {x: ${last[0]}, y: ${last[1]}}, 'asked')`);
        await page.run(`cgtPage.ask('seek', {frame: 1}, 'asked')`);
        assert.deepStrictEqual((await card(page)).names, ['1id 2 is not in this frame']);
        await drop(page, 'two.obj', 'v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n');
        const places = await find(page, [0, 1]);
        const between = [0, 1].map((c) => Math.round((places[0][c] + places[1][c]) / 2));
        for (const [x, y] of [places[0], between, places[1]])
            await page.run(`cgtPage.ask('ask', {x: ${x}, y: ${y}}, 'asked')`);
        const shown = await card(page);
        assert.strictEqual(shown.measures.length, 3);
        assert.match(shown.names[0], /triangle 0, vertices 0, 1, 2/);
        assert(shown.measures.every((text) => parseFloat(text.split(': ')[1]) > 0));
    });
    await test('keys alone turn, zoom and ask', async () => {
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        await key(page, 'Escape', 27);
        await page.run(`picture.focus()`);
        for (const [name, code, modifiers] of [['ArrowLeft', 37], ['ArrowUp', 38], ['ArrowRight', 39, 8], ['+', 187]]) {
            const before = await camera(page);
            await key(page, name, code, modifiers);
            assert.notStrictEqual(await camera(page), before, name);
        }
        await page.run(`cgtPage.ask('fit', {}, 'picture')`);
        await key(page, 'Enter', 13);
        await page.until(`!card.hidden`, 5);
        await page.screenshot(path.join(out, 'keys.png'));
    });
    await page.close();
}

async function testAsk(browser, address, out) {
    await testPicks(browser, address, [1280, 720], false, out);
    await testPicks(browser, address, [390, 844], true, out);
    await testSelections(browser, address, out);
}

module.exports = {testAsk};
