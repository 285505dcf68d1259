// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// How files come to the page: compressed, chosen and dropped again, several together. Called by test_page.js.
'use strict';
const assert = require('assert'), fs = require('fs'), os = require('os'), path = require('path'), zlib = require('zlib');
const {test, read, expect, drop, key, style, compare} = require('./page_tools.js');

const cases = path.join(__dirname, '../readers/cases'), samples = path.join(__dirname, '../readers/data');
const message = (page) => page.run(`document.getElementById('message').textContent`);
const frames = (page) => page.run(`+document.getElementById('time').max + 1`);
const atom = (x) => `1\n\nC ${x} 0 0\n`;

async function testGzip(page) {
    const run = read('pour2k.lammpstrj'), all = run.toString().split('TIMESTEP').length - 1, half = run.length >> 1;
    const members = [run.subarray(0, 70000), run.subarray(70000, half), Buffer.alloc(0), run.subarray(half)];
    const gz = Buffer.concat(members.map((part, k) => zlib.gzipSync(part, {level: [0, 9, 6, 1][k]})));
    await test('gzip: all members are read, with zeros behind them', async () => {
        for (const zeros of [0, 512]) {
            await drop(page, 'run.lammpstrj.gz', Buffer.concat([gz, Buffer.alloc(zeros)]));
            assert.strictEqual(await page.run('cgtPage.error'), '');
            assert.strictEqual(await frames(page), all);
            assert.strictEqual(await message(page), `run.lammpstrj: ${all} frames`);
        }
        await style(page, 'plain');
        await page.run(`cgtPage.ask('seek', {frame: ${all - 1}}, 'picture')`);
        await page.run(`cgtPage.ask('fit', {}, 'picture')`);
        await compare(page, path.join(__dirname, '../../examples/data/pour2k.lammpstrj'), 'plain', all - 1);
    });
    await test('gzip: of what ends too early the whole frames are shown, and it is told', async () => {
        await drop(page, 'run.lammpstrj.gz', gz.subarray(0, gz.length - 30000));
        const few = await frames(page);
        assert(few > all / 2 && few < all, `${few} frames`);
        await page.until(`/ends too early/.test(document.getElementById('message').textContent)`, 5);
    });
    await test('gzip: what is damaged, or stands behind it, is told', async () => {
        const damaged = Buffer.from(gz);
        damaged[gz.length - 6] ^= 1; // of the last checksum
        await drop(page, 'run.lammpstrj.gz', damaged);
        assert.strictEqual(await page.run('cgtPage.error'), 'run.lammpstrj.gz: is damaged gzip');
        await drop(page, 'one.xyz.gz', Buffer.concat([zlib.gzipSync(atom(1)), Buffer.from('more')]));
        assert.strictEqual(await page.run('cgtPage.error'), '');
        assert.match(await message(page), /^one\.xyz\.gz: what stands behind the compressed part is left out/);
    });
    await test('what else compresses is refused by its name', async () => {
        for (const [kind, ...head] of [['Zstandard', 0x28, 0xb5, 0x2f, 0xfd], ['xz', 0xfd, 0x37, 0x7a, 0x58, 0x5a, 0],
                                       ['bzip2', 0x42, 0x5a, 0x68], ['LZ4', 4, 0x22, 0x4d, 0x18],
                                       ['zip', 0x50, 0x4b, 3, 4]]) {
            await drop(page, 'run.xyz.zst', Buffer.from([...head, 1, 2, 3, 4]));
            assert.strictEqual(await page.run('cgtPage.error'),
                `run.xyz.zst: is compressed by ${kind}, and the page unpacks gzip alone: unpack it first`);
        }
    });
}

async function testAgain(page, folder) {
    const at = (name) => path.join(folder, name);
    const place = () => page.run(`cgtPage.ask('describe', {element: 0}, 'described').then((m) => m.text)`);
    const choose = (...names) => expect(page, async () => {
        const {result} = await page.do('Runtime.evaluate', {expression: `document.getElementById('file')`});
        await page.do('DOM.setFileInputFiles', {files: names.map(at), objectId: result.objectId});
    });
    const dropReal = (name) => expect(page, async () => {
        const data = {items: [], files: [at(name)], dragOperationsMask: 1};
        for (const type of ['dragEnter', 'dragOver', 'drop'])
            await page.do('Input.dispatchDragEvent', {type, x: 100, y: 100, data});
    });
    const again = () => expect(page, () => key(page, 'r', 82));
    await test('a file that is chosen again is read again', async () => {
        fs.writeFileSync(at('run.xyz'), atom(1));
        fs.writeFileSync(at('other.xyz'), atom(2));
        for (const [name, x] of [['run.xyz', 1], ['other.xyz', 2], ['run.xyz', 1]]) {
            await choose(name);
            assert.match(await place(), new RegExp(`at  ${x}, 0, 0`));
        }
        fs.writeFileSync(at('run.xyz'), atom(5));
        await choose('run.xyz');
        assert.match(await place(), /at {2}5, 0, 0/);
        await again();
        assert.strictEqual(await page.run('cgtPage.error'), '');
        fs.writeFileSync(at('run.xyz'), atom(66)); // a file that was chosen is as it was then
        await again();
        assert.match(await page.run('cgtPage.error'), /^run\.xyz: has changed since it was chosen/);
    });
    await test('a file that was dropped is read again as it is now', async () => {
        await dropReal('run.xyz');
        assert.match(await place(), /at {2}66, 0, 0/);
        fs.writeFileSync(at('run.xyz'), atom(777));
        await again();
        assert.match(await place(), /at {2}777, 0, 0/);
        fs.unlinkSync(at('run.xyz'));
        await again();
        assert.strictEqual(await page.run('cgtPage.error'), 'run.xyz: is no longer there');
        fs.mkdirSync(at('folder'));
        await dropReal('folder');
        assert.strictEqual(await page.run('cgtPage.error'), 'folder: is a folder: open its files');
        await key(page, 's', 83); // what was opened before is listed
        const names = await page.run(`[...document.querySelectorAll('#recent button')].map((b) => b.textContent)`);
        assert.deepStrictEqual(names.slice(0, 2), ['run.xyz', 'other.xyz']);
        await expect(page, () => page.run(`document.querySelectorAll('#recent button')[1].click()`));
        assert.match(await place(), /at {2}2, 0, 0/);
        await key(page, 's', 83);
    });
}

async function testSeveral(page) {
    const of = (name) => path.join(cases, name), bytes = (file) => fs.readFileSync(file);
    await test('several files: a run and its topology', async () => {
        await style(page, 'plain');
        for (const [run, top] of [[of('topology_psf/by_id.lammpstrj'), of('topology_psf/all.psf')],
                                  [path.join(samples, 'water.xtc'), path.join(samples, 'water.gro')]]) {
            await drop(page, path.basename(top), bytes(top), path.basename(run), bytes(run));
            assert.strictEqual(await page.run('cgtPage.error'), '');
            assert.strictEqual(await page.run('cgtPage.opened'), path.basename(run));
            await compare(page, run, 'plain', 0, ['--topology', top]);
            assert.match(await page.run(`cgtPage.ask('describe', {element: 0}, 'described').then((m) => m.text)`), /resname {2}[A-Z]/);
        }
    });
    await test('several files: those of a run, in the order of their numbers', async () => {
        const of = (k) => [`run.${k}.xyz`, atom(k)];
        await drop(page, ...of(10), ...of(9), ...of(2));
        assert.strictEqual(await page.run('cgtPage.error'), '');
        assert.strictEqual(await frames(page), 3);
        for (const [frame, x] of [[0, 2], [1, 9], [2, 10]]) {
            await page.run(`cgtPage.ask('seek', {frame: ${frame}}, 'picture')`);
            assert.match(await page.run(`cgtPage.ask('describe', {element: 0}, 'described').then((m) => m.text)`),
                new RegExp(`at  ${x}, 0, 0`));
        }
    });
    await test('several files: a mesh beside the spheres', async () => {
        const wall = 'v -3 -3 -3\nv 3 -3 -3\nv 3 3 -3\nv -3 3 -3\nf 1 2 3 4\n';
        const file = path.join(os.tmpdir(), `cgt_wall_${process.pid}.obj`);
        fs.writeFileSync(file, wall);
        try {
            await drop(page, 'wall.obj', wall, 'caffeine.xyz', read('caffeine.xyz'));
            assert.strictEqual(await page.run('cgtPage.error'), '');
            await compare(page, path.join(__dirname, '../../examples/data/caffeine.xyz'), 'plain', 0, ['--mesh', file]);
        } finally {
            fs.unlinkSync(file);
        }
    });
    await test('names without an ending, and those of folders', async () => {
        const poscar = 'C\n1\n5 0 0\n0 5 0\n0 0 5\nC O\n1 1\nDirect\n0 0 0\n0.5 0.5 0.5\n';
        for (const [name, text, sphere] of [['POSCAR', poscar, /O/], ['dev', read('pour2k.lammpstrj'), /type/],
                                            ['-', read('pour2k.lammpstrj'), /type/], ['a %s \u00e4.xyz', atom(3), /C/]]) {
            await drop(page, name, text);
            assert.strictEqual(await page.run('cgtPage.error'), '', name);
            assert.match(await page.run(`cgtPage.ask('describe', {element: ${name === 'POSCAR' ? 1 : 0}}, 'described')
                .then((m) => m.text.split('\\n')[0])`), sphere);
        }
    });
    await test('a large run has all of its frames', async () => {
        const text = [...Array(8).keys()].map((k) => '90\n\n' + `C ${k} 0 0${' '.repeat(99000)}\n`.repeat(90)).join('');
        await drop(page, 'large.xyz.gz', zlib.gzipSync(text));
        assert.strictEqual(await page.run('cgtPage.error'), '');
        assert.strictEqual(await frames(page), 8);
        await page.run(`cgtPage.ask('seek', {frame: 7}, 'picture')`);
        assert.match(await page.run(`cgtPage.ask('describe', {element: 0}, 'described').then((m) => m.text)`),
            /at {2}7, 0, 0/);
    });
    await test('several files that do not go together are refused', async () => {
        const psf = bytes(of('topology_psf/all.psf'));
        for (const [files, says] of [
            [['a.psf', psf, 'b.psf', psf, 'c.xyz', atom(1)], 'only one of a.psf, b.psf can be the topology'],
            [['a.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n', 'b.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'],
             'only one of a.frames, b.frames can be the mesh'],
            [['a.itp', '; nothing\n'], '.itp files belong to a .top file: open it with them'],
            [['a.xyz', atom(1), 'b.gro', bytes(path.join(samples, 'water.gro'))], /b\.gro|a\.xyz/]]) {
            await drop(page, ...files);
            const error = await page.run('cgtPage.error');
            assert(typeof says === 'string' ? error === says : says.test(error), error);
        }
    });
}

async function testFiles(browser, address) {
    const page = await browser.open(address), folder = fs.mkdtempSync(path.join(os.tmpdir(), 'cgt-files-'));
    await testGzip(page);
    await testAgain(page, folder);
    await testSeveral(page);
    await page.close();
    fs.rmSync(folder, {recursive: true});
}

module.exports = {testFiles};
