// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// node test_page.js PAGES CGT_RENDER NATIVE_PICK OUT [REGEX]
// The page in Chromium: what it shows is compared with native programs. Screenshots go to OUT. REGEX chooses tests by
// their names. Prints a line for each test; exit code 0 if none failed. Times are printed, and judged by nobody.
'use strict';
const assert = require('assert'), fs = require('fs'), path = require('path'), zlib = require('zlib');
const {execFileSync} = require('child_process');
const {serve, start} = require('./chromium.js');
const {test, count, read, settle, camera, pixels, compare, mouse, drag, style, drop, key, entryOf, edit, contrast, width,
       height, data} = require('./page_tools.js');
const {testAsk} = require('./test_ask.js');
const {testFiles} = require('./test_files.js');
const {testOut} = require('./test_out.js');

const [pages, , pick, out] = process.argv.slice(2);

// Spheres in a ball, by a generator of our own.
function cloud(count) {
    let x = 12345, text = `${count}\n\n`;
    const next = () => (x = (Math.imul(x, 1664525) + 1013904223) >>> 0) / 4294967296 - 0.5;
    for (let i = 0; i < count; i++)
        text += `A ${(60 * next()).toFixed(3)} ${(60 * next()).toFixed(3)} ${(60 * next()).toFixed(3)}\n`;
    return text;
}

// Milliseconds of 200 pictures, each asked for when the one before is on the canvas: what the engine took, by its clock,
// and until it was shown. Where other programs run, the least says more than the median.
async function measure(page) {
    await page.run(`document.getElementById('style').value = 'plain', document.getElementById('style').onchange()`);
    await settle(page);
    const times = await page.run(`(async () => {
        const times = [];
        for (let i = 0; i < 200; i++) {
            const begin = performance.now(), picture = await cgtPage.ask('turn', {x: 3, y: 0}, 'picture');
            times.push([picture.milliseconds, performance.now() - begin]);
        }
        return times;
    })()`);
    const of = (k) => {
        const sorted = times.map((t) => t[k]).sort((a, b) => a - b);
        return `median ${sorted[100].toFixed(1)} ms, least ${sorted[0].toFixed(1)}`;
    };
    return `made in ${of(0)}; shown in ${of(1)}`;
}

// ---- The panel of options, in a window of a size ------------------------------------------------------------------

async function testPanel(browser, address, [across, down]) {
    const page = await browser.open(address), name = `panel, ${across} pixels wide`;
    const same = async (a) => Buffer.compare(a, await pixels(page)) === 0;
    await page.do('Emulation.setDeviceMetricsOverride',
        {width: across, height: down, deviceScaleFactor: 1, mobile: false});
    await drop(page, 'pour2k.lammpstrj', read('pour2k.lammpstrj'));
    await page.run(`cgtPage.ask('seek', {frame: 20}, 'picture').then(() => cgtPage.ask('fit', {}, 'picture'))`);
    await test(`${name}: each option has a control with a label and help`, async () => {
        await key(page, 'o', 79);
        await page.until(`document.querySelector('[data-option]')`);
        const rows = await page.run(`cgtPage.ask('options').then((m) => m.rows)`);
        const found = await page.run(`[...document.querySelectorAll('[data-option]')].map((e) => ({
            name: e.dataset.option,
            control: e.querySelector('label').control && e.querySelector('label').control.id,
            help: e.querySelector('.help').textContent,
            types: [...e.querySelectorAll('.control > *')].map((c) => c.type || c.tagName)}))`);
        assert.deepStrictEqual(found.map((f) => f.name), rows.map((row) => row.name));
        const types = {switch: 'checkbox', word: 'select-one', number: 'number', whole: 'number', color: 'color'};
        rows.forEach((row, i) => {
            assert.strictEqual(found[i].control, 'option-' + row.name);
            assert.strictEqual(found[i].help, row.help);
            assert(found[i].types.includes(types[row.kind] || (row.repeats ? 'textarea' : 'text')), row.name);
        });
        for (const [name, is] of [['title', true], ['axes', true], ['font', false], ['camera-keys', false], ['size', false]])
            assert.strictEqual(rows.some((row) => row.name === name), is, name);
        const [wide, hidden, left, right, high, pictureWide, pictureHigh] = await page.run(`(() => {
            const p = document.getElementById('panel'), b = p.getBoundingClientRect();
            const picture = document.getElementById('picture');
            return [document.documentElement.scrollWidth, p.scrollWidth - p.clientWidth, b.left, b.right, b.height,
                    picture.clientWidth, picture.clientHeight];
        })()`);
        assert(wide <= across && hidden <= 0, `${wide}, ${hidden} pixels`);
        assert(left >= 0 && right <= across && high >= 250, `${left}, ${right}, ${high}`);
        assert(pictureWide >= 300 && pictureHigh >= 200, `the picture is ${pictureWide}x${pictureHigh}`);
        return `${rows.length} options`;
    });
    await test(`${name}: changes show, and are undone`, async () => {
        await settle(page);
        const pictures = [await pixels(page)];
        for (const [option, value] of [['trails', '3'], ['type-element', '1=O'], ['color', 'z'],
                                       ['background', '203040'], ['box', undefined], ['background', '604020'],
                                       ['bonds', '1.1'], ['show', 'z < 5\nx > 0'], ['style', 'plain']]) {
            if (option === 'style')
                await page.run(`(() => { cgtPage.left = -1; const s = document.getElementById('option-style');
                    s.value = 'plain'; s.onchange(); })()`);
            else
                await edit(page, option, value);
            await settle(page);
            assert.strictEqual(await page.run(`document.getElementById('option-${option}-refused').textContent`), '');
            assert(!await same(pictures.at(-1)), `${option} changes nothing`);
            pictures.push(await pixels(page));
            assert.strictEqual(await page.run('cgtPage.frame'), 20);
        }
        await page.screenshot(path.join(out, `panel_${across}.png`));
        assert.strictEqual(await page.run(`document.getElementById('style').value`), 'plain');
        for (pictures.pop(); pictures.length; pictures.pop()) {
            await page.run(`cgtPage.left = -1; document.activeElement.blur()`);
            await (pictures.length % 2 ? key(page, 'u', 85) : key(page, 'z', 90, 2));
            await settle(page);
            assert(await same(pictures.at(-1)), `undo ${pictures.length}`);
        }
        assert(await page.run(`document.getElementById('undo').disabled`));
    });
    await test(`${name}: what is refused says why, and keeps the picture`, async () => {
        const before = await pixels(page);
        for (const [option, value, says] of [['show', 'z < 5 &&', /show/], ['color', 'no_such', /no column "no_such"/],
                                             ['fill', '200', /fill/], ['background', 'nonsense', /background/]]) {
            const state = () => page.run(`(() => {
                const p = document.getElementById('option-${option}-refused'), e = ${entryOf(option)};
                return [p.textContent, p.getAttribute('role'), p.offsetHeight > 0, e.getAttribute('aria-invalid'),
                    e.value];
            })()`);
            await edit(page, option, value);
            const [text, ...rest] = await state();
            assert.match(text, says);
            assert.deepStrictEqual(rest, ['alert', true, 'true', value]);
            assert(await same(before), option);
            if (option === 'show')
                await page.screenshot(path.join(out, `refused_${across}.png`));
            assert(await contrast(page) >= 4.5, `contrast ${await contrast(page)}`);
            await page.run(`document.querySelector('[data-option="${option}"] [title^=Reset]').click()`);
            assert.deepStrictEqual(await state(), ['', 'alert', false, 'false', '']);
        }
        const put = await page.run(`cgtPage.ask('put', {name: 'range', values: '1,2\\n3,4\\n'})`);
        assert.deepStrictEqual([put.before, put.after, put.text], ['', '', 'range: the option takes one value']);
        await edit(page, 'background', 'navy');
        assert(!await same(before));
        await page.run(`cgtPage.left = -1; document.querySelector('[data-option=background] [title^=Reset]').click()`);
        await settle(page);
        assert(await same(before), 'reset');
    });
    await test(`${name}: keys`, async () => {
        await key(page, 'Escape', 27);
        assert(await page.run(`document.getElementById('panel').hidden && document.activeElement.id === 'options'`));
        await key(page, 'Enter', 13);
        assert(await page.run(`!document.getElementById('panel').hidden && document.activeElement.id === 'close'`));
        await page.run(`document.getElementById('option-color').focus()`);
        await key(page, 'o', 79); // typed, not a command
        assert(await page.run(`!document.getElementById('panel').hidden`));
        assert.strictEqual(await page.run(`document.getElementById('option-color').value`), 'o');
    });
    await page.close();
}

// What is seen first, in a window of a size.
async function testFirst(browser, address, [across, down], isTouched) {
    const page = await browser.open(address), name = `first sight, ${across} pixels wide`;
    await page.do('Emulation.setDeviceMetricsOverride',
        {width: across, height: down, deviceScaleFactor: 1, mobile: isTouched});
    await page.do('Emulation.setTouchEmulationEnabled', {enabled: isTouched});
    await page.run('window.isOld = true');
    await page.do('Page.reload');
    await page.until('!window.isOld && window.cgtPage && cgtPage.opened && cgtPage.pictures');
    await test(`${name}: a run plays in soft light, and a few words tell what to do`, async () => {
        await page.until(`/, [1-9][\\d,]* primitives$/.test(document.getElementById('frame').textContent)`, 10);
        await page.until(`document.getElementById('play').textContent === 'Pause' && cgtPage.frame > 2`, 20);
        assert.strictEqual(await page.run(`document.getElementById('style').value`), 'soft');
        const hint = await page.run(`document.getElementById('hint').textContent`);
        assert.strictEqual(hint, isTouched ? 'drag, pinch, open a file' : 'drag, scroll, drop a file');
        const [wide, bar, picture] = await page.run(`[document.documentElement.scrollWidth,
            document.getElementById('bar').offsetHeight, picture.clientWidth * picture.clientHeight]`);
        assert(wide <= across && bar <= 90 && picture > 0.8 * across * down, `${wide}, ${bar}, ${picture}`);
        assert(await contrast(page) >= 4.5, `contrast ${await contrast(page)}`);
        await page.screenshot(path.join(out, `first_${across}.png`));
    });
    await test(`${name}: a ${isTouched ? 'finger' : 'drag'} turns it, and the words go`, async () => {
        const before = await camera(page);
        if (isTouched) {
            const touch = (type, points) => page.do('Input.dispatchTouchEvent', {type, touchPoints: points});
            await touch('touchStart', [{x: 150, y: 300, id: 1}]);
            for (let i = 1; i <= 5; i++)
                await touch('touchMove', [{x: 150 + 12 * i, y: 300 + 5 * i, id: 1}]);
            await touch('touchEnd', []);
        } else {
            await drag(page, [300, 200], [360, 225]);
        }
        assert.notStrictEqual(await camera(page), before);
        assert(await page.run(`document.getElementById('hint').hidden`));
    });
    await test(`${name}: Tab comes to all that can be used`, async () => {
        const found = new Set();
        await page.run(`document.activeElement.blur()`);
        for (let i = 0; i < 14; i++) {
            await key(page, 'Tab', 9);
            found.add(await page.run(`document.activeElement.id`));
        }
        const all = await page.run(`[...document.querySelectorAll('canvas, button, input, select, textarea')]
            .filter((e) => e.getClientRects().length && !e.disabled).map((e) => e.id)`);
        assert(all.length >= 9 && all.every((id) => found.has(id)), `${all}; ${[...found]}`);
        const names = await page.run(`[...document.querySelectorAll('button, input, select, textarea, canvas')]
            .filter((e) => !(e.textContent.trim() || e.getAttribute('aria-label') || (e.labels && e.labels.length)))
            .map((e) => e.id)`);
        assert.deepStrictEqual(names, [], 'without a name');
    });
    await page.close();
}

async function main() {
    const alone = await serve(pages, false), isolated = await serve(pages, true), browser = await start();
    const url = (server, query) => `${server.url}/cgt-web.html?${query}`;
    const small = `size=${width}x${height}&empty`;
    fs.mkdirSync(out, {recursive: true});

    await test('the shipped run is shown', async () => {
        const page = await browser.open(url(alone, ''));
        await page.until('cgtPage.pictures && cgtPage.opened');
        assert.strictEqual(await page.run('cgtPage.error'), '');
        assert.strictEqual(await page.run('cgtPage.threads'), 1);
        const first = await page.run('Math.round(cgtPage.first)');
        await page.until(`document.getElementById('play').textContent === 'Pause'`); // and it plays, in soft light
        await page.until('cgtPage.frame > 1');
        assert.strictEqual(await page.run(`document.getElementById('style').value`), 'soft');
        assert.strictEqual(await page.run(`document.getElementById('hint').textContent`), 'drag, scroll, drop a file');
        await drag(page, [300, 200], [320, 210]);
        await page.until(`document.getElementById('hint').hidden`);
        await page.until(`!document.getElementById('play').disabled`);
        await page.run(`cgtPage.ask('seek', {frame: 9}, 'picture')`);
        await page.screenshot(path.join(out, 'shipped.png'));
        await style(page, 'soft');
        await settle(page);
        await page.screenshot(path.join(out, 'shipped_soft.png'));
        await page.close();
        return `first picture after ${first} ms`;
    });
    await testFirst(browser, url(isolated, ''), [1280, 720], false);
    await testFirst(browser, url(isolated, ''), [390, 844], true);
    for (const [name, server] of [['one thread', alone], ['all threads', isolated]]) {
        const page = await browser.open(url(server, small));
        await page.until('cgtPage.ready');
        await test(`${name}: threads`, async () => {
            const cpus = await page.run('navigator.hardwareConcurrency');
            assert.strictEqual(await page.run('cgtPage.threads'), server === alone ? 1 : Math.min(cpus, 16));
            return `${await page.run('cgtPage.threads')}`;
        });
        await test(`${name}: plain pixels are cgt-render's`, async () => {
            await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
            assert.strictEqual(await page.run('cgtPage.error'), '');
            await style(page, 'plain');
            await compare(page, path.join(data, 'caffeine.xyz'), 'plain');
        });
        await test(`${name}: a drag turns, and the pixels are cgt-render's`, async () => {
            const before = await camera(page);
            await drag(page, [300, 200], [420, 260]);
            await settle(page);
            assert.notStrictEqual(await camera(page), before);
            assert(await page.run('cgtPage.pictures') > 1);
            await compare(page, path.join(data, 'caffeine.xyz'), 'plain');
        });
        await test(`${name}: soft pixels are cgt-render's`, async () => {
            await style(page, 'soft');
            await compare(page, path.join(data, 'caffeine.xyz'), 'soft');
            await page.screenshot(path.join(out, `caffeine_${server === alone ? 1 : 'all'}.png`));
            await style(page, 'plain');
        });
        await test(`${name}: picks what native code picks`, async () => {
            const places = [];
            for (let y = 5; y < height; y += 19)
                for (let x = 7; x < width; x += 23)
                    places.push(x, y);
            const native = execFileSync(pick, [path.join(data, 'caffeine.xyz'), await camera(page), width, height,
                ...places].map(String), {encoding: 'utf8'}).trim().split('\n').map(Number);
            const picked = [];
            for (let i = 0; i < places.length; i += 2)
                picked.push(await page.run(`cgtPage.ask('pick', {x: ${places[i]}, y: ${places[i + 1]}}, 'picked')
                                            .then((m) => m.id)`));
            assert.deepStrictEqual(picked, native);
            assert(new Set(picked).size > 8);
        });
        await page.close();
    }

    const page = await browser.open(url(isolated, small));
    await test('a click picks what is under it', async () => {
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        await settle(page);
        const box = await page.run(`(() => { const b = document.getElementById('picture').getBoundingClientRect();
                                             return [b.width, b.height]; })()`);
        const x = 170, y = 90, at = [(x + 0.5) * box[0] / width, (y + 0.5) * box[1] / height];
        const asked = await page.run(`cgtPage.ask('pick', {x: ${x}, y: ${y}}, 'picked').then((m) => m.id)`);
        await page.run('cgtPage.picked = null');
        await mouse(page, 'mousePressed', ...at);
        await mouse(page, 'mouseReleased', ...at, 0);
        await page.until('cgtPage.picked !== null');
        assert.strictEqual(await page.run('cgtPage.picked'), asked);
        assert(asked >= 0);
        assert.match(await page.run(`document.querySelector('#picks summary').textContent`),
            new RegExp(`^1sphere ${asked}, type \\d+, [A-Z][a-z]?$`));
    });
    await test('a compressed LAMMPS run, frames in any order', async () => {
        await style(page, 'plain');
        await drop(page, 'pour2k.lammpstrj.gz', zlib.gzipSync(read('pour2k.lammpstrj')));
        assert.strictEqual(await page.run('cgtPage.error'), '');
        await page.until(`!document.getElementById('play').disabled`);
        const frames = read('pour2k.lammpstrj').toString().split('ITEM: TIMESTEP').length - 1;
        assert.strictEqual(await page.run(`+document.getElementById('time').max`), frames - 1);
        for (const frame of [20, 3, 4]) {
            await page.run(`cgtPage.ask('seek', {frame: ${frame}}, 'picture')`);
            assert.strictEqual(await page.run('cgtPage.frame'), frame);
        }
        await page.run(`cgtPage.ask('fit', {}, 'picture')`);
        await compare(page, path.join(data, 'pour2k.lammpstrj'), 'plain', 4);
        const spheres = +read('pour2k.lammpstrj').toString().split('NUMBER OF ATOMS\n')[5].split('\n')[0];
        assert.strictEqual(await page.run(`document.getElementById('frame').textContent`),
            `frame 4, ${spheres.toLocaleString('en')} primitives`);
        assert.match(await page.run(`document.getElementById('message').textContent`), / frames$/);
    });
    const set = async (page, name, value) => {
        const text = await page.run(`(() => { cgtPage.left = -1;
            return cgtPage.ask('set', {name: '${name}', value: ${JSON.stringify(value)}}).then((m) => m.text); })()`);
        await settle(page);
        return text;
    };
    await test('options are those of cgt-render, and pictures with them', async () => {
        const rows = await page.run(`cgtPage.ask('options').then((m) => m.rows)`);
        assert(rows.length > 60);
        for (const row of rows)
            assert(row.name && row.group && row.help && row.kind, JSON.stringify(row));
        assert.deepStrictEqual(rows.find((row) => row.name === 'style').words.split(/,? /), ['soft', 'paper', 'plain']);
        const file = path.join(data, 'caffeine.xyz');
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        for (const [name, value] of [['bonds', null], ['radius-scale', '0.3'], ['color', 'x'], ['style', 'paper']])
            assert.strictEqual(await set(page, name, value), '');
        const options = ['--bonds', '--radius-scale=0.3', '--color=x'];
        await compare(page, file, 'paper', 0, options);
        assert.match(await set(page, 'color', 'no_such'), /has no column "no_such"/);
        assert.match(await set(page, 'colour', 'red'), /there is no option "colour"/);
        await compare(page, file, 'paper', 0, options);
        assert.strictEqual(await set(page, 'bonds', undefined), '');
        await compare(page, file, 'paper', 0, options.slice(1));
        await drop(page, 'cube.obj', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3 4\n'); // for which they are not
        assert.strictEqual(await page.run('cgtPage.error'), '');
        await page.until(`/^options are left out: .* for spheres/.test(document.getElementById('message').textContent)`);
        assert.strictEqual(await set(page, 'style', 'plain'), '');
    });
    await test('a run begins where it shows something', async () => {
        await drop(page, 'pour2k.lammpstrj', read('pour2k.lammpstrj'));
        assert.strictEqual(await page.run('cgtPage.frame'), 3);
        await page.run(`cgtPage.ask('seek', {frame: 0}, 'picture')`);
        assert.strictEqual(await page.run('cgtPage.frame'), 0);
    });
    await test('the first frame has the speeds towards the second', async () => {
        const file = path.join(out, 'steps.xyz'), rows = [[0, 1, 3], [5, 1, -2]];
        fs.writeFileSync(file, rows.map((x) => `3\n\nC ${x[0]} 0 0\nC ${x[1]} 3 0\nC ${x[2]} 6 0\n`).join(''));
        await drop(page, 'steps.xyz', fs.readFileSync(file));
        assert.strictEqual(await set(page, 'color', 'speed'), '');
        assert.strictEqual(await page.run('cgtPage.frame'), 0);
        assert.match(await page.run(`cgtPage.ask('describe', {element: 0}, 'described').then((m) => m.text)`), /speed {2}5$/m);
        await compare(page, file, 'plain', 0, ['--color=speed', '--range=' + await page.run(
            `cgtPage.ask('settings').then((m) => /range = (.*)/.exec(m.text)[1])`)]);
        assert.strictEqual(await set(page, 'color', undefined), '');
    });
    await test('two fingers zoom', async () => {
        const before = (await camera(page)).split(',').map(Number);
        const touch = (type, points) => page.do('Input.dispatchTouchEvent', {type, touchPoints: points});
        await touch('touchStart', [{x: 300, y: 200, id: 1}, {x: 400, y: 200, id: 2}]);
        for (let i = 1; i <= 5; i++)
            await touch('touchMove', [{x: 300 - 10 * i, y: 200, id: 1}, {x: 400 + 10 * i, y: 200, id: 2}]);
        await touch('touchEnd', []);
        await settle(page);
        const after = (await camera(page)).split(',').map(Number);
        const far = (c) => Math.hypot(c[0] - c[3], c[1] - c[4], c[2] - c[5]);
        assert(Math.abs(far(after) / far(before) - 0.5) < 0.05, `${far(after) / far(before)}`);
    });
    await test('a mesh', async () => {
        const cube = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n' +
            'f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2/1 3/2 7/3 6/4\nf -8 -4 -1 -5\n';
        await drop(page, 'cube.obj', cube);
        assert.strictEqual(await page.run('cgtPage.error'), '');
        await settle(page);
        assert.strictEqual(await page.run(`document.getElementById('frame').textContent`), 'frame 0, 12 primitives');
        const shown = await pixels(page);
        let other = 0;
        for (let i = 0; i < shown.length; i += 3)
            other += shown[i] !== 0x3a;
        assert(other > 5000, `${other} pixels of the cube`);
    });
    await test('errors are shown', async () => {
        for (const [name, text, says] of [
            ['noise.xyz', 'nonsense', /noise\.xyz.*1/], ['half.xyz', read('caffeine.xyz').subarray(0, 300), /half\.xyz/],
            ['empty.lammpstrj', '', /no frame|empty/], ['bad.xyz.gz', Buffer.from([0x1f, 0x8b, 1, 2, 3]), /bad\.xyz/],
            ['bad.obj', 'v 0 0 0\nf 1 2 3\n', /bad\.obj: line 2/]]) {
            await drop(page, name, text);
            assert.match(await page.run('cgtPage.error'), says, name);
            assert.strictEqual(await page.run(`document.getElementById('message').className`), 'error');
        }
        await page.screenshot(path.join(out, 'error.png'));
        const cut = read('pour2k.lammpstrj').subarray(0, 400000), whole = cut.toString().split('TIMESTEP').length - 2;
        await drop(page, 'cut.lammpstrj', cut); // what is whole is shown, and a sentence
        assert.strictEqual(await page.run(`+document.getElementById('time').max`), whole - 1);
        await page.until(`/^cut\\.lammpstrj:\\d+: /.test(document.getElementById('message').textContent)`);
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        assert.strictEqual(await page.run('cgtPage.error'), '');
    });
    await test('memory stays flat over 1,000 frames', async () => {
        await drop(page, 'pour2k.lammpstrj', read('pour2k.lammpstrj'));
        await page.run(`cgtPage.send('rate', {rate: 10000}), document.getElementById('play').onclick()`);
        const memory = async (pictures) => {
            await page.until(`cgtPage.pictures >= ${pictures}`, 300);
            return page.run(`cgtPage.ask('memory')`);
        };
        const before = await memory(130), after = await memory(1130);
        await page.run(`document.getElementById('play').onclick()`);
        assert.strictEqual(after.bytes, before.bytes);
        assert(after.used <= before.used + (1 << 20), `${before.used} to ${after.used} bytes in use`);
        return `${(after.used / 1048576).toFixed(1)} of ${after.bytes / 1048576} MiB`;
    });
    await page.close();
    for (const size of [[1280, 720], [390, 844]])
        await testPanel(browser, url(isolated, small), size);
    await testFiles(browser, url(isolated, small));
    await testAsk(browser, url(isolated, small), out);
    await testOut(browser, url(isolated, small), out);
    await test('inside another page the wheel acts after a click', async () => {
        const around = await browser.open(url(isolated, small));
        const inner = `<iframe src="${url(isolated, small)}" width="400" height="300"></iframe>`;
        await around.run(`document.body.innerHTML = '${inner}'`);
        await around.until(`frames[0] && frames[0].cgtPage && frames[0].cgtPage.ready`);
        await around.run(`frames[0].cgtPage.open('caffeine.xyz', ${JSON.stringify(read('caffeine.xyz').toString())})`);
        await around.until(`frames[0].cgtPage.pictures`);
        const turnWheel = async () => {
            await around.do('Input.dispatchMouseEvent', {type: 'mouseWheel', x: 150, y: 100, deltaX: 0, deltaY: 200});
            await new Promise((done) => setTimeout(done, 200));
            return around.run(`frames[0].cgtPage.ask('camera').then((m) => m.text)`);
        };
        const before = await around.run(`frames[0].cgtPage.ask('camera').then((m) => m.text)`);
        assert.strictEqual(await around.run(`getComputedStyle(frames[0].picture).touchAction`), 'auto');
        assert.strictEqual(await turnWheel(), before);
        await mouse(around, 'mousePressed', 150, 100);
        await mouse(around, 'mouseReleased', 150, 100, 0);
        assert.notStrictEqual(await turnWheel(), before);
        assert.strictEqual(await around.run(`getComputedStyle(frames[0].picture).touchAction`), 'none');
        await around.close();
    });
    await test('a picture of 1280x720', async () => {
        const lines = [];
        for (const [name, server] of [['one thread', alone], ['all threads', isolated]])
            for (const count of [2000, 100000]) {
                const big = await browser.open(url(server, 'size=1280x720&empty'));
                await drop(big, 'cloud.xyz', cloud(count));
                lines.push(`\n  ${count} spheres, ${name}: ${await measure(big)}`);
                if (server === alone)
                    await big.screenshot(path.join(out, `cloud_${count}.png`));
                await big.close();
            }
        return lines.join('');
    });

    await browser.close();
    alone.close();
    isolated.close();
    process.exit(count.failed ? 1 : 0);
}
main().catch((error) => {
    console.log(`FAILED: ${error.stack}`);
    process.exit(1);
});
