// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// Movies and archives, written by the engine's worker: WebM (Matroska, RFC 9559) of what the browser's encoder gives,
// or a series of PNG files in a zip file without compression, since they have their own.
/* exported makePictures */

// The archive of [{name, bytes}]. Names are of ASCII.
function writeZip(files) {
    const sums = Uint32Array.from({length: 256}, (_, k) => {
        for (let i = 0; i < 8; i++)
            k = k >>> 1 ^ (k & 1 ? 0xedb88320 : 0);
        return k;
    });
    const words = (...pairs) => { // [value, bytes], little-endian
        const out = [];
        for (const [value, count] of pairs)
            for (let k = 0; k < count; k++)
                out.push(value / 256 ** k & 255);
        return Uint8Array.from(out);
    };
    const parts = [], directory = [], day = 0x21; // the first of 1980: the same bytes at any time
    let at = 0;
    const add = (list, part) => { list.push(part); return part.length; };
    for (const {name, bytes} of files) {
        let sum = ~0;
        for (const byte of bytes)
            sum = sum >>> 8 ^ sums[(sum ^ byte) & 255];
        const letters = new TextEncoder().encode(name), size = [bytes.length, 4];
        const about = [[20, 2], [0, 2], [0, 2], [0, 2], [day, 2], [~sum >>> 0, 4], size, size, [letters.length, 2],
                       [0, 2]];
        directory.push(words([0x02014b50, 4], [20, 2], ...about, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]), letters);
        at += add(parts, words([0x04034b50, 4], ...about)) + add(parts, letters) + add(parts, bytes);
    }
    const length = directory.reduce((sum, part) => sum + part.length, 0), count = [files.length, 2];
    if (files.length > 65535 || at + length >= 2 ** 32)
        throw new Error('the pictures are too many, or too large, for one zip file');
    const end = words([0x06054b50, 4], [0, 2], [0, 2], count, count, [length, 4], [at, 4], [0, 2]);
    return new Blob([...parts, ...directory, end], {type: 'application/zip'});
}

// A movie of frames [{bytes, isKey}], so many a second.
function writeWebm(frames, {codec, width, height, rate}) {
    const join = (parts) => {
        const out = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
        parts.reduce((at, part) => { out.set(part, at); return at + part.length; }, 0);
        return out;
    };
    const big = (value, count) => Uint8Array.from({length: count}, (_, k) => value / 256 ** (count - 1 - k) & 255);
    const text = (letters) => new TextEncoder().encode(letters);
    const double = (value) => { const out = new DataView(new ArrayBuffer(8)); out.setFloat64(0, value);
                                return new Uint8Array(out.buffer); };
    // An element: its id, its size in eight bytes, what it holds.
    const element = (id, ...parts) => {
        const inside = join(parts), idBytes = big(id, Math.ceil(Math.log2(id + 1) / 8));
        const size = big(inside.length, 8);
        size[0] = 1;
        return join([idBytes, size, inside]);
    };
    const number = (id, value) => element(id, big(value, 6));
    const most = 30000; // milliseconds of a cluster: times in it have two bytes
    const time = (k) => Math.round(1000 * k / rate), clusters = [];
    for (let k = 0; k < frames.length;) {
        const begin = time(k), blocks = [number(0xe7, begin)];
        do {
            blocks.push(element(0xa3, Uint8Array.of(0x81), big(time(k) - begin, 2),
                                Uint8Array.of(frames[k].isKey ? 0x80 : 0), frames[k].bytes));
            k++;
        } while (k < frames.length && !(frames[k].isKey && time(k) > begin) && time(k) - begin < most);
        clusters.push(element(0x1f43b675, ...blocks));
    }
    return new Blob([
        element(0x1a45dfa3, number(0x4286, 1), number(0x42f7, 1), number(0x42f2, 4), number(0x42f3, 8),
                element(0x4282, text('webm')), number(0x4287, 4), number(0x4285, 2)),
        element(0x18538067,
            element(0x1549a966, number(0x2ad7b1, 1000000), element(0x4489, double(1000 * frames.length / rate)),
                    element(0x4d80, text('libcgt')), element(0x5741, text('libcgt'))),
            element(0x1654ae6b, element(0xae, number(0xd7, 1), number(0x73c5, 1), number(0x83, 1),
                number(0x23e383, 1e9 / rate), element(0x86, text(codec)),
                element(0xe0, number(0xb0, width), number(0xba, height)))),
            ...clusters)], {type: 'video/webm'});
}

// The browser's encoder for pictures of a size, or null where it has none that is known here: add(pixels, k) gives it
// the pixels of picture k, end() makes the movie.
async function createEncoder(width, height, rate) {
    const codecs = [['vp09.00.51.08', 'V_VP9'], ['vp8', 'V_VP8']], frames = [], apart = 60; // from key to key
    const bitrate = Math.min(40e6, Math.round(6 * width * height * Math.sqrt(rate / 30)));
    for (const [codec, name] of codecs) {
        const settings = {codec, width, height, bitrate, framerate: rate};
        if (typeof VideoEncoder === 'undefined' || !(await VideoEncoder.isConfigSupported(settings)).supported)
            continue;
        let failure = null;
        const encoder = new VideoEncoder({
            output: (chunk) => {
                const bytes = new Uint8Array(chunk.byteLength);
                chunk.copyTo(bytes);
                frames.push({bytes, isKey: chunk.type === 'key'});
            },
            error: (error) => { failure = error; },
        });
        encoder.configure(settings);
        return {
            async add(pixels, k) {
                const options = {format: 'RGBX', codedWidth: width, codedHeight: height,
                                 timestamp: Math.round(1e6 * k / rate), duration: Math.round(1e6 / rate)};
                const frame = new VideoFrame(pixels, options);
                encoder.encode(frame, {keyFrame: k % apart === 0});
                frame.close();
                while (encoder.encodeQueueSize > 2 && !failure)
                    await new Promise((done) => setTimeout(done, 2));
                if (failure)
                    throw failure;
            },
            async end() {
                await encoder.flush();
                encoder.close();
                return writeWebm(frames, {codec: name, width, height, rate});
            },
            drop: () => encoder.state !== 'closed' && encoder.close(),
        };
    }
    return null;
}

// Makes pictures of `m`: {kind: 'picture', 'run', 'orbit'; width, height; first, last, frames of the run; count of an
// orbit; degrees; rate; as: 'zip' or not}. Answers with {name, blob}, or null where it was cancelled.
async function makePictures(cgt, m, {tell, message, isCancelled}) {
    const file = '/picture.png', channel = new MessageChannel();
    const pause = () => new Promise((done) => { channel.port1.onmessage = done; channel.port2.postMessage(0); });
    const check = (result) => {
        if (result < 0)
            throw new Error(message());
        return result;
    };
    const isOne = m.kind === 'picture', numbers = [];
    for (let k = m.kind === 'run' ? m.first : 0; k < (m.kind === 'run' ? m.last + 1 : isOne ? 1 : m.count); k++)
        numbers.push(k);
    const shareOf = (number) => isOne ? 0 : number / (m.kind === 'run' ? m.frames : m.count), files = [];
    const encoder = isOne || m.as === 'zip' ? null : await createEncoder(m.width, m.height, m.rate);
    try {
        check(cgt._web_resize(m.width, m.height));
        check(cgt._web_begin_series(isOne ? 0 : m.degrees));
        for (const [k, number] of numbers.entries()) {
            if (m.kind === 'run')
                check(cgt._web_seek(number));
            check(cgt._web_begin_picture(shareOf(number)));
            for (let left = 1; left > 0;) {
                await pause();
                if (isCancelled())
                    return null;
                left = check(cgt._web_step_picture());
            }
            if (encoder) {
                const pixels = check(cgt._web_read_picture() || -1);
                await encoder.add(cgt.HEAPU8.slice(pixels, pixels + 4 * m.width * m.height), k);
            } else {
                check(cgt.ccall('web_write_picture', 'number', ['string'], [file]));
                files.push({name: `frame_${String(number).padStart(4, '0')}.png`, bytes: cgt.FS.readFile(file)});
                cgt.FS.unlink(file);
            }
            tell('progress', {done: k + 1, of: numbers.length});
        }
        if (isOne)
            return {name: 'picture.png', blob: new Blob([files[0].bytes], {type: 'image/png'})};
        return encoder ? {name: 'movie.webm', blob: await encoder.end()}
            : {name: 'pictures.zip', blob: writeZip(files)};
    } finally {
        if (encoder)
            encoder.drop();
        cgt._web_end_series();
    }
}
