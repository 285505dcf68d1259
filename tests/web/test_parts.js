// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// node test_parts.js PROGRAMS_WEB
// Parts of the page that need no browser: what unpacks gzip where the browser's stream gives up, and what writes archives
// and movies. Prints a line for each test; exit code 0 if none failed.
'use strict';
const assert = require('assert'), fs = require('fs'), path = require('path'), zlib = require('zlib');

const text = (name) => fs.readFileSync(path.join(process.argv[2], name), 'utf8');
const page = text('web_page.js'), begin = page.indexOf('    async function unpack(bytes)');
// With a stream that refuses all, so that the page's own has to do it.
const unpack = new Function('DecompressionStream',
    page.slice(begin, page.indexOf('    // ---- The engine', begin)) + 'return unpack;')(class {
    constructor() {
        return new TransformStream({transform() { throw new TypeError('refused'); }});
    }
});
const {writeZip, writeWebm} = new Function(text('web_movie.js') + 'return {writeZip, writeWebm};')();
const whole = (bytes) => bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);

let x = 2026;
const random = (below) => (x = (Math.imul(x, 1664525) + 1013904223) >>> 0) % below;

const letters = Buffer.from(Array.from({length: 40000}, () => 'ITEM: 0123456789.\n'.charCodeAt(random(18))));
const inputs = [letters, Buffer.alloc(0), Buffer.alloc(70000, 65), Buffer.from(Array.from({length: 9000}, () => random(256))),
                Buffer.from('abcabcabc')];
const members = []; // every kind of block
for (const input of inputs)
    for (const level of [0, 1, 9])
        for (const strategy of [zlib.constants.Z_DEFAULT_STRATEGY, zlib.constants.Z_HUFFMAN_ONLY, zlib.constants.Z_RLE,
                                zlib.constants.Z_FIXED])
            members.push([input, zlib.gzipSync(input, {level, strategy})]);

const tests = {
    async 'members follow each other, and zeros'() {
        for (const [input, packed] of members)
            for (const zeros of [0, 1, 600]) {
                const out = await unpack(whole(Buffer.concat([packed, zlib.gzipSync('tail'), Buffer.alloc(zeros)])));
                assert(Buffer.from(out).equals(Buffer.concat([input, Buffer.from('tail')])));
                assert.strictEqual(out.doubt, '');
            }
        const named = Buffer.from([0x1f, 0x8b, 8, 4 + 8 + 16 + 2, 0, 0, 0, 0, 0, 3, 2, 0, 7, 7, 65, 0, 66, 0, 9, 9]);
        const [input, packed] = members[0];
        assert(Buffer.from(await unpack(whole(Buffer.concat([named, packed.subarray(10)])))).equals(input));
    },
    async 'what ends too early is whole as far as it goes'() {
        let cut = 0;
        for (const [input, packed] of members)
            for (let k = 0; k < 8; k++) {
                const size = 2 + random(packed.length - 2);
                const out = await unpack(whole(packed.subarray(0, size))).catch((error) => {
                    assert.strictEqual(error.message, 'the compressed file ends too early');
                    return null;
                });
                if (!out)
                    continue;
                assert.match(out.doubt, /ends too early/);
                assert(Buffer.from(out).equals(input.subarray(0, out.byteLength)));
                cut++;
            }
        assert(cut > 100, `${cut}`);
    },
    async 'what is damaged is told'() {
        let told = 0;
        for (const [input, packed] of members)
            for (let k = 0; k < 8; k++) {
                const bad = Buffer.from(packed);
                bad[10 + random(bad.length - 10)] ^= 1 << random(8);
                const out = await unpack(whole(bad)).catch((error) => {
                    assert.match(error.message, /^(is damaged gzip|the compressed file ends too early)$/);
                    return null;
                });
                told += !out || out.doubt !== '';
                assert(!out || out.doubt || Buffer.from(out).equals(input)); // a bit that nothing reads
            }
        assert(told > 300, `${told}`);
    },
    async 'a zip file holds its files'() {
        const files = [{name: 'frame_0000.png', bytes: letters}, {name: 'b.png', bytes: Buffer.alloc(0)}];
        const zip = Buffer.from(await writeZip(files).arrayBuffer()), end = zip.length - 22;
        assert.strictEqual(zip.readUInt32LE(end), 0x06054b50);
        assert.strictEqual(zip.readUInt16LE(end + 10), 2);
        for (let k = 0, at = zip.readUInt32LE(end + 16); k < 2; k++) {
            assert.strictEqual(zip.readUInt32LE(at), 0x02014b50);
            const {name, bytes} = files[k], local = zip.readUInt32LE(at + 42), data = local + 30 + name.length;
            const sum = zlib.gzipSync(bytes).readUInt32LE(zlib.gzipSync(bytes).length - 8);
            assert.strictEqual(zip.toString('latin1', at + 46, at + 46 + name.length), name);
            assert.deepStrictEqual([16, 20, 24].map((c) => zip.readUInt32LE(at + c)), [sum, bytes.length, bytes.length]);
            assert.strictEqual(zip.readUInt32LE(local), 0x04034b50);
            assert.deepStrictEqual([14, 18, 22].map((c) => zip.readUInt32LE(local + c)), [sum, bytes.length, bytes.length]);
            assert(zip.subarray(data, data + bytes.length).equals(bytes));
            at += 46 + name.length;
        }
    },
    async 'a movie has its frames at their times'() {
        const rate = 24, count = 2000, frames = []; // 83 s: times of one cluster end at 32 s
        for (let k = 0; k < count; k++)
            frames.push({bytes: Buffer.from([k & 255, k >> 8]), isKey: k % 60 === 0 || k === 1501});
        const movie = Buffer.from(await writeWebm(frames, {codec: 'V_VP9', width: 320, height: 200, rate}).arrayBuffer());
        const found = new Map(), blocks = [], inside = [0x18538067, 0x1549a966, 0x1654ae6b, 0xae, 0xe0, 0x1f43b675];
        let cluster = 0;
        (function walk(at, end) {
            while (at < end) {
                const idSize = Math.clz32(movie[at]) - 23, id = movie.readUIntBE(at, idSize);
                assert.strictEqual(movie[at + idSize], 1);
                const size = movie.readUIntBE(at + idSize + 2, 6), from = at + idSize + 8;
                if (id === 0xe7)
                    cluster = movie.readUIntBE(from, size);
                if (id === 0xa3)
                    blocks.push([cluster + movie.readInt16BE(from + 1), movie[from + 3] === 0x80,
                                 movie.readUInt16LE(from + 4)]);
                else if (inside.includes(id))
                    walk(from, from + size);
                else
                    found.set(id, movie.subarray(from, from + size));
                at = from + size;
            }
            assert.strictEqual(at, end);
        })(0, movie.length);
        assert.deepStrictEqual(blocks, frames.map((f, k) => [Math.round(1000 * k / rate), f.isKey, k]));
        assert.strictEqual(found.get(0x4489).readDoubleBE(), 1000 * count / rate);
        assert.strictEqual(found.get(0x86).toString(), 'V_VP9');
        assert.deepStrictEqual([0xb0, 0xba].map((id) => found.get(id).readUIntBE(0, 6)), [320, 200]);
    },
};

(async () => {
    let failed = 0;
    for (const [name, body] of Object.entries(tests))
        await body().then(() => console.log('passed: ' + name), (error) => {
            failed++;
            console.log(`FAILED: ${name}: ${error.stack}`);
        });
    process.exit(failed ? 1 : 0);
})();
