// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// What the page gives away: pictures, movies, lines, settings; compared with native programs. Called by test_page.js.
'use strict';
const assert = require('assert'), fs = require('fs'), os = require('os'), path = require('path'), zlib = require('zlib');
const {execFileSync} = require('child_process');
const {test, read, settle, camera, pixels, compare, drop, key, style, contrast, width, height, data} =
    require('./page_tools.js');

const [, render] = process.argv.slice(2).map((file) => path.resolve(file));

// The size and the bytes of a PNG file, three a pixel.
function decode(png) {
    const parts = [], size = [png.readUInt32BE(16), png.readUInt32BE(20)];
    assert.deepStrictEqual([...png.subarray(24, 29)], [8, 2, 0, 0, 0], 'not RGB of eight bits');
    for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
        if (png.toString('latin1', at + 4, at + 8) === 'IDAT')
            parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    const rows = zlib.inflateSync(Buffer.concat(parts)), wide = 3 * size[0], out = Buffer.alloc(wide * size[1]);
    const at = (x, y) => x < 0 || y < 0 ? 0 : out[y * wide + x];
    for (let y = 0; y < size[1]; y++)
        for (let x = 0; x < wide; x++) {
            const a = at(x - 3, y), b = at(x, y - 1), c = x < 3 ? 0 : at(x - 3, y - 1), p = a + b - c;
            const [pa, pb, pc] = [a, b, c].map((v) => Math.abs(p - v));
            const guess = [0, a, b, a + b >> 1, pa <= pb && pa <= pc ? a : pb <= pc ? b : c][rows[y * (wide + 1)]];
            out[y * wide + x] = rows[y * (wide + 1) + 1 + x] + guess;
        }
    return {size, bytes: out};
}
const same = (a, b, what) => {
    assert.strictEqual(a.length, b.length, what);
    let differ = 0;
    for (let i = 0; i < a.length; i++)
        differ += a[i] !== b[i];
    assert(new Set(a).size > 20, `${what}: the picture is empty`);
    assert.strictEqual(differ, 0, `${what}: ${differ} of ${a.length} bytes differ`);
};

// The file that the page gives for a click.
async function save(page, id) {
    await page.run(`cgtPage.saved = null, document.getElementById('${id}').click()`);
    await page.until(`cgtPage.saved || document.getElementById('out-refused').textContent`, 120);
    assert.strictEqual(await page.run(`document.getElementById('out-refused').textContent`), '');
    const [name, text] = await page.run(`cgtPage.saved.blob.arrayBuffer().then((b) => { let t = '';
        for (const x of new Uint8Array(b)) t += String.fromCharCode(x); return [cgtPage.saved.name, btoa(t)]; })`);
    return {name, bytes: Buffer.from(text, 'base64')};
}
const fill = (page, values) => page.run(`for (const [id, value] of ${JSON.stringify(Object.entries(values))}) {
    const e = document.getElementById(id); e.value = value; e.dispatchEvent(new Event('change', {bubbles: true})); }`);
const put = (page, name, values) => page.run(`cgtPage.left = -1;
    cgtPage.ask('put', {name: '${name}', values: ${JSON.stringify(values)}}).then((m) => m.text)`)
    .then((text) => assert.strictEqual(text, ''));
const refused = (page) => page.run(`document.getElementById('out-refused').textContent`);

async function testPictures(page) {
    const file = path.join(data, 'caffeine.xyz');
    await test('the picture that is saved is that of cgt-render', async () => {
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        await style(page, 'paper');
        await settle(page);
        await key(page, 's', 83);
        for (const size of [[width, height], [150, 130]]) {
            await fill(page, {'out-size': size[0] === width ? '' : size.join('x')});
            const saved = await save(page, 'save-picture'), png = decode(saved.bytes);
            assert.strictEqual(saved.name, 'picture.png');
            assert.deepStrictEqual(png.size, size);
            same(png.bytes, execFileSync(render, ['-c', await camera(page), '-s', size.join('x'), '--style=paper', '-o', '-',
                file], {stdio: ['ignore', 'pipe', 'ignore']}), size.join('x'));
            await compare(page, file, 'paper'); // what is shown is as it was
        }
        for (const size of ['12', '0x5', '99999x99999', 'wide']) {
            await fill(page, {'out-size': size});
            await page.run(`document.getElementById('save-picture').click()`);
            assert.match(await refused(page), /^the size is pixels/);
            const [text, panel] = await page.run(`['out-refused', 'save'].map((id) =>
                document.getElementById(id).getBoundingClientRect().bottom)`);
            assert(text > 0 && text <= panel, `${text} of ${panel}: the sentence is not seen`);
        }
        await fill(page, {'out-size': ''});
    });
}

async function testLines(page, folder) {
    const lines = async () => {
        await settle(page);
        await page.run(`cgtPage.ask('settings')`);
        return page.run(`[document.getElementById('command').value, document.getElementById('python').value]`);
    };
    const check = async (files) => {
        const [command, python] = await lines(), here = fs.mkdtempSync(path.join(folder, 'lines-'));
        for (const [name, bytes] of files)
            fs.writeFileSync(path.join(here, name), bytes);
        assert(command.startsWith('cgt-render '));
        execFileSync('sh', ['-c', `'${render}' -q --no-metadata ${command.slice(11)}`],
            {cwd: here, stdio: ['ignore', 'pipe', 'pipe']});
        same(decode(fs.readFileSync(path.join(here, 'picture.png'))).bytes, await pixels(page), command);
        // keywords and values are those of the command line; the package itself is tested elsewhere
        const told = JSON.parse(execFileSync('python3', ['-c', 'import ast, json, sys\n' +
            'tree = ast.parse(sys.stdin.read())\n' +
            'calls = {ast.unparse(c.func): c for c in ast.walk(tree) if isinstance(c, ast.Call)}\n' +
            'print(json.dumps([{k.arg: ast.literal_eval(k.value) for k in calls["cgt.Figure"].keywords},' +
            ' ast.unparse(calls["cgt.read"]) if len(calls) < 7 else "", ast.unparse(tree)]))'], {input: python}));
        const settings = await page.run(`cgtPage.ask('settings').then((m) => m.text)`), wanted = {};
        for (const [name, value] of settings.trim().split('\n').map((line) => line.split(/ = (.*)/))) {
            const word = name.replace(/-/g, '_'), given = value === undefined ? true : value;
            wanted[word] = word in wanted ? [].concat(wanted[word], [given]) : given;
        }
        const one = (value) => [].concat(value).length === 1 ? [].concat(value)[0] : value; // a list of one is that one
        assert.deepStrictEqual(Object.fromEntries(Object.entries(told[0]).map(([k, value]) => [k, one(value)])), wanted);
        return [command, told[2]];
    };
    await test('the command line makes the same picture, and the lines of Python say the same', async () => {
        const caffeine = [['caffeine.xyz', read('caffeine.xyz')]];
        await drop(page, ...caffeine[0]);
        for (const [name, values] of [['bonds', '\n'], ['radius-scale', '0.3\n'], ['show', `element != "H" or x > 0\nz < 9\n`],
                                      ['type-color', 'O=gold\nN=navy\n'], ['background', '203040\n'], ['ortho', '\n']])
            await put(page, name, values);
        const [command] = await check(caffeine);
        assert(command.includes(`'--show=element != "H" or x > 0' '--show=z < 9'`), command);
        for (const name of ['bonds', 'radius-scale', 'show', 'type-color', 'background', 'ortho'])
            await put(page, name, '');
        const texts = [['title', 'Caffeine, C₈H₁₀N₄O₂\n'], ['axes', '\n'], ['legend', '\n'], ['scale-bar', '2,Å\n'],
                       ['label', 'element == "O"\n'], ['label-text', '{element} {x}\n']];
        for (const [name, values] of texts)
            await put(page, name, values);
        await check(caffeine);
        for (const [name] of texts.reverse())
            await put(page, name, '');
        const run = [["it's a run.lammpstrj", read('pour2k.lammpstrj')]];
        await drop(page, ...run.flat());
        await style(page, 'soft');
        for (const frame of [7, 0, 20]) {
            await page.run(`cgtPage.left = -1; cgtPage.ask('seek', {frame: ${frame}}, 'picture')`);
            await page.run(`cgtPage.left = -1; cgtPage.ask('fit', {}, 'picture')`);
            if (frame) {
                const [, python] = await check(run);
                assert(python.includes(`run[${frame - 1}:${frame + 1}]`), python); // the one before, for speeds
            }
        }
        await put(page, 'trails', '3\n');
        const [, trails] = await check(run);
        assert(trails.includes('run[17:21]'), trails); // and those of its trails
        await put(page, 'trails', '');
        const samples = path.join(__dirname, '../readers/data');
        const several = ['water.xtc', 'water.gro'].map((name) => [name, fs.readFileSync(path.join(samples, name))]);
        const wall = ['wall.obj', Buffer.from('v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\n')];
        await drop(page, ...several.flat(), ...wall);
        const [all, python] = await check([...several, wall]);
        assert(all.includes('--topology=water.gro --mesh=wall.obj') && python.includes("topology='water.gro'"), python);
        assert(python.includes(`set_mesh(cgt.read('wall.obj')[0])`), python);
    });
}

async function testMovies(page, folder, out) {
    const file = path.join(data, 'pour2k.lammpstrj');
    await test('a series of the run is that of cgt-render, with an orbit', async () => {
        await drop(page, 'pour2k.lammpstrj', read('pour2k.lammpstrj'));
        await style(page, 'plain');
        await page.run(`cgtPage.ask('seek', {frame: 12}, 'picture').then(() => cgtPage.ask('fit', {}, 'picture'))`);
        await settle(page);
        await fill(page, {'movie-kind': 'run', 'movie-as': 'zip'});
        await fill(page, {'movie-first': 9, 'movie-last': 11, 'movie-degrees': 90});
        const before = await pixels(page), {name, bytes} = await save(page, 'save-movie');
        assert.strictEqual(name, 'pictures.zip');
        fs.writeFileSync(path.join(folder, name), bytes);
        execFileSync('python3', ['-m', 'zipfile', '-t', path.join(folder, name)]);
        execFileSync('python3', ['-m', 'zipfile', '-e', path.join(folder, name), folder]);
        const native = execFileSync(render, ['-c', await camera(page), '-s', `${width}x${height}`, '--style=plain', '--orbit=90',
            '--first=9', '--last=11', '-o', '-', file], {maxBuffer: 1 << 26, stdio: ['ignore', 'pipe', 'ignore']});
        for (let k = 0; k < 3; k++) {
            const png = decode(fs.readFileSync(path.join(folder, `frame_${String(9 + k).padStart(4, '0')}.png`)));
            same(png.bytes, native.subarray(k * png.bytes.length, (k + 1) * png.bytes.length), `frame ${9 + k}`);
        }
        await settle(page);
        same(await pixels(page), before, 'what is shown afterwards');
    });
    await test('a run goes on when a picture of it is saved', async () => {
        await page.run(`document.getElementById('play').onclick()`);
        await save(page, 'save-picture');
        await page.until(`cgtPage.frame !== ${await page.run('cgtPage.frame')}`, 20);
        assert.strictEqual(await page.run(`document.getElementById('play').textContent`), 'Pause');
        await page.run(`document.getElementById('play').onclick()`);
    });
    await test('a movie of an orbit plays', async () => {
        await fill(page, {'movie-kind': 'orbit', 'movie-as': 'movie'});
        await fill(page, {'movie-seconds': 1.5, 'movie-rate': 10, 'movie-degrees': 360, 'out-size': '321x200'});
        const {name, bytes} = await save(page, 'save-movie');
        assert.strictEqual(name, 'movie.webm');
        const told = await page.run(`new Promise((done) => {
            const video = document.createElement('video'), canvas = document.createElement('canvas');
            video.muted = true;
            video.onerror = () => done(video.error.message);
            video.onloadeddata = async () => {
                const seen = [];
                for (const time of [0.05, 0.75, 1.45]) {
                    video.currentTime = time;
                    await new Promise((next) => { video.onseeked = next; });
                    canvas.width = video.videoWidth;
                    canvas.height = video.videoHeight;
                    canvas.getContext('2d').drawImage(video, 0, 0);
                    seen.push(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data
                        .reduce((sum, byte, k) => (sum * 31 + byte * (k % 4 < 3)) % 1000003, 0));
                }
                done([video.videoWidth, video.videoHeight, video.duration, new Set(seen).size]);
            };
            video.src = URL.createObjectURL(cgtPage.saved.blob);
        })`);
        assert.deepStrictEqual(told, [320, 200, 1.5, 3]);
        assert.match(await page.run(`document.getElementById('progress-text').textContent`), /^15 of 15 pictures$/);
        return `${bytes.length} bytes`;
    });
    await test('a movie is cancelled', async () => {
        await settle(page);
        const before = await pixels(page);
        await fill(page, {'movie-seconds': 600, 'movie-rate': 60, 'out-size': '640x360'});
        await page.run(`cgtPage.saved = null, document.getElementById('save-movie').click()`);
        await page.until(`/^[1-9]\\d* of 36000/.test(document.getElementById('progress-text').textContent)`);
        await page.screenshot(path.join(out, 'movie.png'));
        await page.run(`cgtPage.left = -1, document.getElementById('cancel').click()`);
        await page.until(`document.getElementById('making').hidden`, 20);
        assert.strictEqual(await page.run(`document.getElementById('message').textContent`), 'cancelled');
        assert.strictEqual(await page.run(`cgtPage.saved`), null);
        await fill(page, {'out-size': ''});
        await settle(page);
        same(await pixels(page), before, 'what is shown afterwards');
    });
    await test('what cannot be a movie is refused', async () => {
        for (const [values, says] of [[{'movie-seconds': ''}, /^seconds must be a number from 0\.1 to 600/],
                                      [{'movie-seconds': 6, 'movie-rate': 500}, /^pictures a second must/],
                                      [{'movie-rate': 30, 'movie-kind': 'run', 'movie-first': 99}, /^the first frame must/],
                                      [{'movie-first': 9, 'movie-last': 3}, /^the last frame comes before/]]) {
            await fill(page, values);
            await page.run(`document.getElementById('save-movie').click()`);
            assert.match(await refused(page), says);
        }
        assert(await contrast(page) >= 4.5, `contrast ${await contrast(page)}`);
        await page.screenshot(path.join(out, 'refused_movie.png'));
    });
}

async function testSettings(browser, address, page, folder) {
    const message = (on) => on.run(`document.getElementById('message').textContent`);
    const give = async (on, name, text) => { // drops a settings file
        const before = await on.run(`cgtPage.loads`);
        await on.run(`(() => { cgtPage.left = -1; const f = new DataTransfer();
            f.items.add(new File([${JSON.stringify(text)}], ${JSON.stringify(name)}));
            dispatchEvent(new DragEvent('drop', {dataTransfer: f})); })()`);
        await on.until(`cgtPage.loads > ${before}`, 20);
    };
    await test('lines are copied, and settings loaded, by their buttons', async () => {
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        await settle(page);
        await page.run(`cgtPage.ask('settings')`);
        await page.do('Browser.grantPermissions', {permissions: ['clipboardReadWrite', 'clipboardSanitizedWrite']});
        await page.do('Page.bringToFront');
        for (const id of ['command', 'python']) {
            await page.run(`document.getElementById('copy-${id}').click()`);
            await page.until(`document.getElementById('copy-${id}').textContent === 'Copied'`, 5);
            const [copied, shown] = await page.run(`navigator.clipboard.readText().then((text) =>
                [text, document.getElementById('${id}').value])`);
            assert(shown.includes('caffeine.xyz'));
            assert.strictEqual(copied, shown);
        }
        const file = path.join(folder, 'red.conf');
        fs.writeFileSync(file, 'background = 802020\nstyle = plain\n');
        const {result} = await page.do('Runtime.evaluate', {expression: `document.getElementById('load-settings')`});
        const before = await page.run(`cgtPage.loads`);
        await page.run('cgtPage.left = -1');
        await page.do('DOM.setFileInputFiles', {files: [file], objectId: result.objectId});
        await page.until(`cgtPage.loads > ${before}`, 20);
        await compare(page, path.join(data, 'caffeine.xyz'), 'plain', 0, ['--background=802020']);
    });
    await test('settings are saved, and read by cgt-render and another page', async () => {
        await drop(page, 'caffeine.xyz', read('caffeine.xyz'));
        await style(page, 'paper');
        await put(page, 'bonds', '\n');
        await put(page, 'show', 'element != "H" or x > 0\n');
        await put(page, 'title', '  set in \n');
        await page.run(`cgtPage.ask('turn', {x: 30, y: 10}, 'picture')`);
        await settle(page);
        await fill(page, {'out-size': ''});
        await page.run(`cgtPage.ask('settings')`);
        const {name, bytes} = await save(page, 'save-settings'), file = path.join(folder, name);
        fs.writeFileSync(file, bytes);
        const native = execFileSync(render, ['-q', '--settings', file, '-o', '-', path.join(data, 'caffeine.xyz')],
            {stdio: ['ignore', 'pipe', 'ignore']});
        same(await pixels(page), native, 'cgt-render --settings');
        const other = await browser.open(address);
        const turn = () => other.run(`cgtPage.ask('turn', {x: 30, y: 10}, 'picture')`);
        await drop(other, 'caffeine.xyz', read('caffeine.xyz'));
        await turn();
        await settle(other);
        const before = await pixels(other);
        await give(other, name, bytes.toString());
        await settle(other);
        same(await pixels(other), native, 'another page');
        assert.strictEqual(await other.run(`document.getElementById('style').value`), 'paper');
        const undo = async () => {
            await other.run(`cgtPage.left = -1, document.activeElement.blur()`);
            await key(other, 'u', 85);
            await settle(other);
        };
        await undo();
        same(await pixels(other), before, 'undone');
        await put(other, 'title', ' kept ');
        await give(other, 'few.settings', 'style = plain\n');
        await undo();
        assert.strictEqual(await other.run(`document.querySelector('[data-option=title] input').value`), ' kept ');
        await turn();
        const turned = await camera(other);
        await give(other, 'few.settings', 'style = plain\n'); // without a camera
        assert.strictEqual(await camera(other), turned);
        await undo();
        assert.strictEqual(await camera(other), turned);
        await give(other, 'few.settings', 'quality = 5\nstyle = plain\nsize = 99x99\n');
        assert.match(await message(other), /left out.*: quality$/);
        await settle(other);
        await compare(other, path.join(data, 'caffeine.xyz'), 'plain');
        const plain = await pixels(other);
        for (const [text, says] of [['style = plain\nfill = 200\n', /^wrong\.settings:2: .*fill/], ['radius-scale', /^wrong\.settings:1: /],
                                    ['color = no_such\n', /no_such/]]) {
            await give(other, 'wrong.settings', text);
            assert.match(await other.run(`cgtPage.error`), says);
            await settle(other);
            same(await pixels(other), plain, text);
        }
        await give(other, 'near.settings', 'camera = 0,0,9,0,0,0,0,1,0,30\n');
        assert.strictEqual(await camera(other), '0,0,9,0,0,0,0,1,0,30');
        await drop(other, 'pour2k.lammpstrj', read('pour2k.lammpstrj')); // which lies elsewhere
        assert.notStrictEqual(await camera(other), '0,0,9,0,0,0,0,1,0,30');
        await other.close();
    });
}

async function testOut(browser, address, out) {
    const page = await browser.open(address), folder = fs.mkdtempSync(path.join(os.tmpdir(), 'cgt-out-'));
    await testPictures(page);
    await testLines(page, folder);
    await testMovies(page, folder, out);
    await testSettings(browser, address, page, folder);
    await page.close();
    fs.rmSync(folder, {recursive: true});
}

module.exports = {testOut};
