// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// The page of cgt-web. Emscripten's createCgt stands before this text in one script, which runs three times: in the
// page, as the engine's worker, which owns the library, and as each of the library's threads, where nothing here runs.
(() => {
    'use strict';
    const script = typeof document !== 'undefined' ? document.currentScript.src : self.location.href;

    // ---- Compressed files -------------------------------------------------------------------------------------------

    // Bytes, unpacked where they are gzip's: all members, as bgzip, appended logs and `cat a.gz b.gz` have them, and no
    // zeros behind them. A file that ends too early gives what there is, with a sentence in `doubt`.
    async function unpack(bytes) {
        const packed = new Uint8Array(bytes), most = Math.max(2 ** 30, 500 * packed.length);
        if (packed[0] !== 0x1f || packed[1] !== 0x8b)
            return bytes;
        const tooMuch = () => new Error('unpacks to more than 1 GiB and 500 times its size');
        const parts = [], reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')).getReader();
        try { // the browser's own takes one member, and does not say what it does not like
            for (let size = 0, part; !(part = await reader.read()).done; parts.push(part.value))
                if ((size += part.value.length) > most)
                    throw tooMuch();
            return await new Blob(parts).arrayBuffer();
        } catch (error) {
            reader.cancel().catch(() => {});
            if (error instanceof RangeError || error.message === tooMuch().message)
                throw error;
        }

        // RFC 1952 and 1951. `at` is of the next byte, `bits` has `held` bits of those before it.
        const early = new Error('the compressed file ends too early'), damaged = () => new Error('is damaged gzip');
        let at = 0, bits = 0, held = 0, out = new Uint8Array(4 * packed.length + 1024), size = 0, members = 0;
        const fill = (count) => {
            for (; held < count && at < packed.length; held += 8)
                bits |= packed[at++] << held;
        };
        const drop = (count) => {
            if (count > held)
                throw early;
            bits >>>= count;
            held -= count;
        };
        const take = (count) => {
            fill(count);
            const value = bits & (1 << count) - 1;
            drop(count);
            return value;
        };
        const byte = () => {
            if (at >= packed.length)
                throw early;
            return packed[at++];
        };
        const whole32 = () => (byte() | byte() << 8 | byte() << 16 | byte() << 24) >>> 0;
        const room = (count) => {
            if (size + count > most)
                throw tooMuch();
            if (size + count <= out.length)
                return;
            const larger = new Uint8Array(Math.min(most, Math.max(2 * out.length, size + count)));
            larger.set(out);
            out = larger;
        };
        // A code by its lengths: what the next bits mean, as 16 * symbol + length; 0: nothing.
        const makeCode = (lengths) => {
            const longest = Math.max(...lengths), table = new Uint16Array(1 << longest);
            for (let length = 1, code = 0; length <= longest; length++, code <<= 1)
                for (let symbol = 0; symbol < lengths.length; symbol++)
                    if (lengths[symbol] === length) {
                        let reversed = 0;
                        for (let k = 0; k < length; k++)
                            reversed |= (code >> k & 1) << length - 1 - k;
                        if (code++ >= 1 << length)
                            throw damaged();
                        for (; reversed < table.length; reversed += 1 << length)
                            table[reversed] = 16 * symbol + length;
                    }
            return {table, longest};
        };
        const decode = ({table, longest}) => {
            fill(longest);
            const entry = table[bits & (1 << longest) - 1];
            if (!entry && held >= longest)
                throw damaged();
            drop(entry & 15 || 32);
            return entry >> 4;
        };
        const readCodes = () => { // of letters and lengths, and of distances
            const letters = take(5) + 257, distances = take(5) + 1, count = take(4) + 4;
            const order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15], few = new Uint8Array(19);
            for (let k = 0; k < count; k++)
                few[order[k]] = take(3);
            const code = makeCode(few), lengths = new Uint8Array(letters + distances);
            for (let k = 0; k < lengths.length;) {
                const symbol = decode(code);
                const times = symbol < 16 ? 1 : symbol === 18 ? 11 + take(7) : 3 + take(symbol === 16 ? 2 : 3);
                if (symbol === 16 && !k || k + times > lengths.length)
                    throw damaged();
                lengths.fill(symbol < 16 ? symbol : symbol === 16 ? lengths[k - 1] : 0, k, k += times);
            }
            return [makeCode(lengths.subarray(0, letters)), makeCode(lengths.subarray(letters))];
        };
        const fixed = [makeCode([...Array(288).keys()].map((k) => k < 144 ? 8 : k < 256 ? 9 : k < 280 ? 7 : 8)),
                       makeCode(Array(30).fill(5))];
        const copyStored = () => {
            at -= held >> 3;
            bits = held = 0;
            const length = byte() | byte() << 8;
            if ((length ^ (byte() | byte() << 8)) !== 0xffff)
                throw damaged();
            const there = packed.subarray(at, at + length);
            room(length);
            out.set(there, size);
            at += there.length;
            size += there.length;
            if (there.length < length)
                throw early;
        };
        const inflateBlock = ([letters, distances], begin) => {
            for (let symbol; (symbol = decode(letters)) !== 256;) {
                if (symbol < 256) {
                    room(1);
                    out[size++] = symbol;
                    continue;
                }
                if (symbol > 285)
                    throw damaged();
                const k = symbol - 257, more = k < 8 || k === 28 ? 0 : (k >> 2) - 1;
                const length = k === 28 ? 258 : more ? (4 + (k & 3) << more) + 3 + take(more) : k + 3;
                const d = decode(distances), moreOfIt = d < 4 ? 0 : (d >> 1) - 1;
                const distance = moreOfIt ? (2 + (d & 1) << moreOfIt) + 1 + take(moreOfIt) : d + 1;
                if (d > 29 || distance > size - begin)
                    throw damaged();
                room(length);
                for (let i = 0; i < length; i++, size++)
                    out[size] = out[size - distance];
            }
        };
        const sums = Uint32Array.from({length: 256}, (_, k) => {
            for (let i = 0; i < 8; i++)
                k = k >>> 1 ^ (k & 1 ? 0xedb88320 : 0);
            return k;
        });
        const inflateMember = () => {
            const begin = size;
            bits = held = 0;
            if (byte() !== 0x1f || byte() !== 0x8b || byte() !== 8)
                throw damaged();
            const flags = byte();
            for (let k = 0; k < 6; k++)
                byte();
            for (let left = flags & 4 ? byte() | byte() << 8 : 0; left; left--)
                byte();
            for (const flag of [8, 16]) // name, comment
                while (flags & flag && byte());
            for (let k = 0; flags & 2 && k < 2; k++)
                byte();
            for (let last = 0; !last;) {
                last = take(1);
                const kind = take(2);
                if (kind === 3)
                    throw damaged();
                if (kind === 0)
                    copyStored();
                else
                    inflateBlock(kind === 1 ? fixed : readCodes(), begin);
            }
            at -= held >> 3;
            let sum = ~0;
            for (let k = begin; k < size; k++)
                sum = sum >>> 8 ^ sums[(sum ^ out[k]) & 255];
            if (whole32() !== ~sum >>> 0 || whole32() !== (size - begin) >>> 0)
                throw damaged();
        };
        let doubt = '';
        try {
            for (; at < packed.length && !(members && packed.subarray(at).every((b) => b === 0)); members++) {
                if (members && (packed[at] !== 0x1f || packed[at + 1] !== 0x8b)) {
                    doubt = 'what stands behind the compressed part is left out';
                    break;
                }
                inflateMember();
            }
        } catch (error) {
            if (error !== early || !size)
                throw error;
            doubt = error.message + ': what is whole is shown';
        }
        return Object.assign(out.slice(0, size).buffer, {doubt});
    }

    // ---- The engine: takes messages, does one thing at a time, and answers with pictures ----------------------------

    async function runEngine() {
        if (!self.SharedArrayBuffer) // hidden without the headers for threads; one thread may have it all the same
            self.SharedArrayBuffer = new WebAssembly.Memory({initial: 0, maximum: 1, shared: true}).buffer.constructor;
        const threads = self.crossOriginIsolated ? Math.min(navigator.hardwareConcurrency || 1, 16) : 1;
        if (threads === 1) // Emscripten of 2022 waits for a thread in any case: one that is never used
            self.Worker = class {
                postMessage() { setTimeout(() => this.onmessage({data: {cmd: 'loaded'}})); }
            };
        // packed, since servers do not pack what they take for a program; one that says so has it unpacked on the way
        const get = (name) => fetch(new URL(name, script)), [packed, font] =
            await Promise.all([get('cgt-web.wasm.gz'), get('cgt-web.ttf.gz')]);
        if (!packed.ok)
            throw new Error('no cgt-web.wasm.gz: ' + packed.status);
        const cgt = await createCgt({
            wasmBinary: await unpack(await packed.arrayBuffer()),
            poolSize: Math.max(1, threads - 1),
            mainScriptUrlOrBlob: script,
            locateFile: (name) => name.endsWith('.worker.js')
                ? URL.createObjectURL(new Blob([threadScript], {type: 'text/javascript'})) : new URL(name, script).href,
        });
        if (font.ok) { // else options that write texts are refused
            cgt.FS.mkdirTree('/usr/share/fonts/dejavu');
            cgt.FS.writeFile('/usr/share/fonts/dejavu/DejaVuSans.ttf',
                             new Uint8Array(await unpack(await font.arrayBuffer())));
        }
        cgt.FS.mkdir('/files'); // of the user, and nothing else
        cgt.FS.chdir('/files');
        const message = () => cgt.UTF8ToString(cgt._web_message());
        const tell = (type, rest, transfer) => self.postMessage({type, ...rest}, transfer || []);
        let width = 0, height = 0, left = 0, begins = false, moved = 0, playing = false, due = 0, frames = 0;
        let rate = 30, isOpen = false, outdated = false, names = [];
        let hasShadows = true, soft = 0; // of pictures in motion; milliseconds of the first step of soft light
        let scheduled = false, timer = 0, spare = [], pending = 0;

        const fail = () => { isOpen = playing = false; left = 0; tell('error', {text: message()}); };
        const started = cgt._web_start(threads);
        if (started < 0)
            return fail();
        tell('ready', {threads: started});

        const places = cgt._malloc(64); // of marks
        let told = -1, selection = ''; // the frame of which was told what was picked
        const findMarks = () => [...new Float32Array(cgt.HEAPU8.buffer, places, 2 * cgt._web_marks(places))];
        const tellAsked = () =>
            tell('asked', {...JSON.parse(cgt.UTF8ToString(cgt._web_asked())), marks: findMarks()});
        function tellSelected() {
            const count = selection ? cgt.ccall('web_select', 'number', ['string'], [selection]) : 0;
            tell('selected', {formula: selection, count, of: isOpen ? cgt._web_primitives() : 0, text: message()});
        }

        function show(milliseconds) {
            const bytes = 4 * width * height, pixels = cgt._web_pixels();
            const old = spare.pop(), buffer = old && old.byteLength === bytes ? old : new ArrayBuffer(bytes);
            pending++; // a picture cannot be made of shared memory: a copy
            new Uint8Array(buffer).set(new Uint8Array(cgt.HEAPU8.buffer, pixels, bytes));
            const frame = cgt._web_frame(), primitives = cgt._web_primitives();
            const marks = findMarks();
            tell('picture', {buffer, width, height, frame, primitives, left, milliseconds, marks}, [buffer]);
            if (frame !== told) { // what was picked and selected may have moved
                told = frame;
                if (marks.length)
                    tellAsked();
                if (selection)
                    tellSelected();
            }
        }

        // Adds a step of the style's light; a frame that is played has the first alone, where it is fast enough.
        function grow() {
            const now = performance.now();
            left = cgt._web_grow(begins ? 1 : 0);
            soft = begins ? performance.now() - now : soft;
            begins = false;
            return left;
        }

        // One step; returns the milliseconds until the next, or nothing.
        function step() {
            const now = performance.now();
            if (!isOpen || !width)
                return undefined;
            if (playing && now >= due) {
                if (cgt._web_seek((cgt._web_frame() + 1) % frames) < 0)
                    return fail();
                due = Math.max(due + 1000 / rate, now);
                outdated = true;
            }
            if (outdated) {
                begins = true;
                if (playing && soft < 1000 / rate) {
                    if (grow() < 0)
                        return fail();
                } else {
                    if (cgt._web_draw(hasShadows ? 1 : 0) < 0)
                        return fail();
                    hasShadows = hasShadows && performance.now() - now < 40; // until the next file
                    left = -1; // not begun
                }
                outdated = false;
                moved = now;
                show(performance.now() - now);
            } else if (left !== 0 && !playing) {
                if (now - moved < 120 && begins)
                    return 120 - (now - moved);
                if (grow() < 0)
                    return fail();
                show(performance.now() - now);
            }
            return playing ? Math.max(0, due - performance.now()) : left !== 0 || outdated ? 0 : undefined;
        }

        // Pictures to save: what else is asked for waits until they are made, or cancelled.
        let making = false, cancelled = false, later = [];
        async function make(m) {
            const before = {width, height, frame: cgt._web_frame()};
            making = true;
            cancelled = playing = false;
            let made = null, text = '';
            try {
                made = isOpen ? await makePictures(cgt, m, {tell, message, isCancelled: () => cancelled}) : null;
            } catch (error) {
                text = error.message;
            }
            making = false;
            if (cgt._web_resize(before.width, before.height) < 0 || (isOpen && cgt._web_seek(before.frame) < 0))
                fail();
            outdated = isOpen;
            tell('made', {...made, text});
            for (const event of later.splice(0))
                self.onmessage(event);
            schedule(0);
        }

        // Events come between steps. While the page shows a picture the next is made, and no more.
        function run() {
            scheduled = false;
            if (pending > 1 || making)
                return;
            const wait = step();
            if (wait !== undefined && pending < 2)
                schedule(wait);
        }
        const channel = new MessageChannel(); // without the least delay of timers
        channel.port1.onmessage = run;
        function schedule(wait) {
            clearTimeout(timer);
            if (wait > 1) {
                timer = setTimeout(run, wait);
            } else if (!scheduled) {
                scheduled = true;
                channel.port2.postMessage(0);
            }
        }

        // What is set: the values of each option, a line each.
        const values = (name) => cgt.ccall('web_values', 'string', ['string'], [name]);
        const tellValues = () =>
            tell('values', {values: Object.fromEntries(names.map((name) => [name, values(name)]))});

        function open({name, count, files, run, topology, mesh, given}) {
            playing = false;
            left = 0;
            for (const old of cgt.FS.readdir('.').filter((f) => f !== '.' && f !== '..'))
                cgt.FS.unlink(old);
            for (const f of files)
                cgt.FS.writeFile(f.name, new Uint8Array(f.bytes));
            const take = (call, names) => cgt.ccall(call, 'number', ['string', 'string', 'string'],
                                                    [names.run.join('\n'), names.topology, names.mesh]);
            const status = take('web_name', given) || take('web_open', {run, topology, mesh});
            isOpen = status === 0;
            outdated = isOpen;
            hasShadows = true;
            soft = 0;
            if (!isOpen)
                return fail();
            frames = cgt._web_frames();
            const columns = JSON.parse(cgt.UTF8ToString(cgt._web_columns()));
            const kind = cgt._web_has_triangles() ? 'triangles' : 'spheres';
            tell('opened', {name, count, frames, columns, kind});
            tellValues();
            for (let text; (text = cgt._web_warning());)
                tell('warning', {text: cgt.UTF8ToString(text)});
            return undefined;
        }

        const actions = {
            open,
            size: (m) => {
                width = m.width;
                height = m.height;
                if (cgt._web_resize(width, height) < 0)
                    fail();
                if (isOpen && m.fit)
                    cgt._web_fit();
                outdated = isOpen;
            },
            options: () => {
                const rows = JSON.parse(cgt.UTF8ToString(cgt._web_options()));
                names = rows.map((row) => row.name);
                tell('options', {rows});
                tellValues();
            },
            set: (m) => { // without a value: null; undefined takes it back
                const isSet = m.value !== undefined;
                const status = isSet ? cgt.ccall('web_set', 'number', ['string', 'string'], [m.name, m.value])
                    : cgt.ccall('web_unset', 'number', ['string'], [m.name]);
                tell('set', {text: status < 0 ? message() : ''});
                tellValues();
                outdated = isOpen;
            },
            put: (m) => { // all values of an option, a line each
                const before = values(m.name);
                const status = cgt.ccall('web_put', 'number', ['string', 'string'], [m.name, m.values]);
                tell('put', {name: m.name, isUndo: m.isUndo, before, after: values(m.name),
                             text: status < 0 ? message() : ''});
                if (isOpen && !cgt._web_frames())
                    return fail();
                tellValues();
                outdated = isOpen;
                return undefined;
            },
            turn: (m) => { cgt._web_turn(m.x, m.y); outdated = isOpen; },
            pan: (m) => { cgt._web_pan(m.x, m.y); outdated = isOpen; },
            zoom: (m) => { cgt._web_zoom(m.x, m.y, m.factor); outdated = isOpen; },
            fit: () => { cgt._web_fit(); outdated = isOpen; },
            play: (m) => {
                playing = m.playing && isOpen && frames > 1;
                due = performance.now();
                outdated = outdated || isOpen;
            },
            rate: (m) => { rate = m.rate; },
            seek: (m) => {
                playing = false;
                if (isOpen && cgt._web_seek(m.frame) < 0)
                    fail();
                outdated = isOpen;
            },
            pick: (m) => { const id = isOpen ? cgt._web_pick(m.x, m.y) : -1; tell('picked', {id, text: message()}); },
            ask: (m) => {
                if (isOpen)
                    cgt._web_ask(m.x, m.y);
                tellAsked();
            },
            forgetPicks: () => { cgt._web_forget_picks(); tellAsked(); },
            select: (m) => { selection = m.formula; tellSelected(); },
            follow: (m) => tell('follow', {count: cgt.ccall('web_follow', 'number', ['string'], [m.formula]),
                                           text: message()}),
            make,
            cancel: () => { cancelled = true; },
            settings: () => {
                const [text, command, python] = ['settings', 'command', 'python']
                    .map((lines) => cgt.UTF8ToString(cgt['_web_' + lines]()));
                tell('settings', {text, command, python});
            },
            load: (m) => { // a settings file
                const path = '/' + m.name.replace(/[/\0]/g, '_');
                let before = values(null);
                // Undo brings back the hand's, where no option of it chooses the view
                if (isOpen && /^\s*camera\s*=/m.test(before + m.text) &&
                    !/^(view|up|fov|zoom|camera-keys)\b/m.test(before))
                    before = before.replace(/^camera = .*\n/m, '') +
                        `camera = ${cgt.UTF8ToString(cgt._web_camera())}\n`;
                cgt.FS.writeFile(path, m.text);
                const status = cgt.ccall('web_load', 'number', ['string'], [path]);
                cgt.FS.unlink(path);
                tell('loaded', {name: m.name, before, isRefused: status < 0, isUndo: m.isUndo,
                                text: message().replace(path, m.name)});
                if (isOpen && !cgt._web_frames())
                    return fail();
                tellValues();
                outdated = isOpen;
                return undefined;
            },
            describe: (m) => tell('described', {text: cgt.ccall('web_describe', 'string', ['number'], [m.element])}),
            camera: () => tell('camera', {text: cgt.UTF8ToString(cgt._web_camera())}),
            memory: () => tell('memory', {bytes: cgt.HEAPU8.buffer.byteLength, used: cgt._web_used()}),
            shown: (m) => { pending--; spare.push(m.buffer); },
        };
        self.onmessage = (event) => {
            if (making && !['cancel', 'shown', 'memory'].includes(event.data.type)) {
                later.push(event);
                return;
            }
            try {
                actions[event.data.type](event.data);
            } catch (error) { // out of memory, above all
                isOpen = playing = false;
                tell('error', {text: 'the page has stopped: ' + error});
            }
            schedule(0);
        };
        for (const event of early)
            self.onmessage(event);
    }

    // ---- The page ---------------------------------------------------------------------------------------------------

    function runPage() {
        const $ = (id) => document.getElementById(id);
        const canvas = $('picture'), context = canvas.getContext('2d', {alpha: false});
        const engine = new Worker(script, {name: 'cgt-engine'});
        const send = (type, rest, transfer) => engine.postMessage({type, ...rest}, transfer || []);
        const begin = performance.now();
        const page = window.cgtPage =
            {ready: 0, first: 0, pictures: 0, left: 0, milliseconds: 0, error: '', picked: null, loads: 0};
        let playing = false, sliding = false, playsFirst = false, waiting = {}, doubts = [], latest = {};
        page.send = send;
        page.ask = (type, rest, answer) => new Promise((done) => { waiting[answer || type] = done; send(type, rest); });

        function say(text, isError) {
            page.error = isError ? text : '';
            $('message').textContent = text;
            $('message').className = isError ? 'error' : '';
        }
        const panel = createPanel($('panel'), {
            put: (name, values, isUndo) => send('put', {name, values, isUndo}),
            load: (text) => send('load', {name: 'undo', text, isUndo: true}),
            say,
        });
        const panels = {panel: {button: 'options', close: 'close', key: 'o'},
                        select: {button: 'selecting', close: 'select-close', key: 'a'},
                        save: {button: 'saving', close: 'save-close', key: 's'}};
        // Opens or closes a panel; one at a time has the room.
        function openPanel(id, on) {
            for (const [other, {button}] of Object.entries(panels)) {
                $(other).hidden = other !== id || !on;
                $(button).setAttribute('aria-expanded', other === id && on);
            }
            $(on ? panels[id].close : panels[id].button).focus();
            if (id === 'save' && on)
                send('settings');
        }
        const ask = createAsk({
            send, openPanel,
            put: (name, values) => send('put', {name, values}),
            valuesOf: (name) => latest[name] || '',
            hasOption: (name) => name in latest,
        });
        const shownPanel = () => Object.keys(panels).find((id) => !$(id).hidden);
        function setPlaying(on) {
            playing = on;
            $('play').textContent = on ? 'Pause' : 'Play';
            send('play', {playing});
        }

        const actions = {
            ready: (m) => { page.ready = performance.now() - begin; page.threads = m.threads; },
            opened: (m) => {
                page.opened = m.name;
                page.columns = m.columns;
                panel.setColumns(m.columns);
                ask.begin(m.columns);
                out.begin(m.frames);
                say(doubts[0] || m.name + (m.count > 1 ? ` and ${m.count - 1} more` : '') +
                    (m.frames > 1 ? ': ' + m.frames + ' frames' : ''));
                $('time').max = Math.max(0, m.frames - 1);
                for (const id of ['time', 'play'])
                    $(id).disabled = m.frames < 2;
                setPlaying(playsFirst && m.frames > 1 && !matchMedia('(prefers-reduced-motion: reduce)').matches);
                playsFirst = false;
                if (!panel.isBuilt())
                    send('options');
            },
            warning: (m) => { doubts.push(m.text); say(doubts.join('; ')); },
            error: (m) => { playing = false; $('play').textContent = 'Play'; say(m.text, true); },
            picture: (m) => {
                if (canvas.width !== m.width || canvas.height !== m.height) {
                    canvas.width = m.width;
                    canvas.height = m.height;
                }
                context.putImageData(new ImageData(new Uint8ClampedArray(m.buffer), m.width, m.height), 0, 0);
                page.first = page.first || performance.now() - begin;
                page.pictures++;
                page.left = m.left;
                page.frame = m.frame;
                page.milliseconds = m.milliseconds;
                ask.showMarks(m.marks);
                if (!$('save').hidden && m.left === 0)
                    send('settings');
                if (!sliding)
                    $('time').value = m.frame;
                $('frame').textContent = 'frame ' + m.frame + ', ' + m.primitives.toLocaleString('en') + ' primitives';
                send('shown', {buffer: m.buffer}, [m.buffer]);
            },
            picked: (m) => { page.picked = m.id; },
            set: (m) => { if (m.text) say(m.text); },
            options: (m) => { if (!panel.isBuilt()) panel.build(m.rows); },
            values: (m) => {
                latest = m.values;
                panel.update(m.values);
                if ('style' in m.values)
                    $('style').value = m.values.style.trim() || 'soft';
            },
            put: (m) => panel.answer(m),
            camera: () => {},
            described: () => {},
            progress: (m) => out.progress(m),
            made: (m) => { out.made(m); if (playing) setPlaying(true); }, // the engine has stopped
            settings: (m) => out.tell(m),
            loaded: (m) => {
                panel.loaded(m);
                page.loads++;
                say(m.text || (m.isUndo ? '' : m.name + ': read'), m.isRefused);
            },
            asked: (m) => { ask.showPicks(m); ask.showMarks(m.marks); },
            selected: (m) => ask.showSelected(m),
            follow: (m) => ask.answerFollow(m),
            memory: () => {},
        };
        engine.onmessage = (event) => {
            const m = event.data;
            actions[m.type](m);
            if (waiting[m.type]) {
                waiting[m.type](m);
                delete waiting[m.type];
            }
        };
        engine.onerror = (event) => say('this browser does not run the page: ' + event.message, true);

        const openSettings = (name, text) => send('load', {name, text});
        const out = createOut({send, say, openSettings, page});
        const files = createFiles({
            unpack,
            openRun: (m) => {
                doubts = m.doubt ? [m.doubt] : [];
                send('open', m, m.files.map((f) => f.bytes));
            },
            openSettings,
            say,
            told: (names) => {
                $('again').disabled = !names.length;
                $('recent').replaceChildren(...names.map((name, k) => {
                    const button = document.createElement('button'), item = document.createElement('li');
                    button.textContent = name;
                    button.onclick = () => files.again(k);
                    item.append(button);
                    return item;
                }));
            },
        });
        page.open = (name, text) => files.open([new File([text], name)]);

        // ---- Size: as many pixels as the window has -----------------------------------------------------------------

        const fixed = new URLSearchParams(location.search).get('size'); // 640x360, for tests
        let size = '';
        function resize() {
            const [w, h] = fixed ? fixed.split('x').map(Number)
                : [canvas.clientWidth * devicePixelRatio, canvas.clientHeight * devicePixelRatio];
            const width = Math.max(1, Math.round(w)), height = Math.max(1, Math.round(h));
            if (size !== width + 'x' + height)
                send('size', {width, height});
            size = width + 'x' + height;
        }
        addEventListener('resize', resize);
        new ResizeObserver(resize).observe(canvas); // the panel takes room from it

        // ---- First sight: what to do; inside another page wheel and touch are that page's until a click ------------

        const isEmbedded = window !== window.top, isTouched = matchMedia('(pointer: coarse)').matches;
        let isActive = !isEmbedded;
        function setActive(on) {
            isActive = on || !isEmbedded;
            canvas.style.touchAction = isActive ? 'none' : 'auto';
        }
        setActive(false);
        $('hint').textContent = isEmbedded ? (isTouched ? 'tap, then drag or pinch' : 'drag, click to scroll in')
            : isTouched ? 'drag, pinch, open a file' : 'drag, scroll, drop a file';
        const endHint = () => { $('hint').hidden = true; };
        canvas.addEventListener('click', () => setActive(true));
        addEventListener('blur', () => setActive(false));

        // ---- Pointers: one turns, two move and zoom, a click picks --------------------------------------------------

        const pointers = new Map();
        let travelled = 0;
        const at = (e) => {
            const box = canvas.getBoundingClientRect();
            return {x: (e.clientX - box.left) * canvas.width / box.width,
                    y: (e.clientY - box.top) * canvas.height / box.height, pan: e.button === 2 || e.shiftKey};
        };
        const spread = () => {
            const [a, b] = [...pointers.values()];
            return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y)};
        };
        canvas.addEventListener('pointerdown', (e) => {
            if (!isActive && e.pointerType === 'touch')
                return;
            endHint();
            canvas.setPointerCapture(e.pointerId);
            pointers.set(e.pointerId, at(e));
            travelled = pointers.size > 1 ? 1e9 : 0;
        });
        canvas.addEventListener('pointermove', (e) => {
            const old = pointers.get(e.pointerId);
            if (!old)
                return;
            const before = pointers.size === 2 ? spread() : null, now = {...at(e), pan: old.pan};
            pointers.set(e.pointerId, now);
            const x = now.x - old.x, y = now.y - old.y;
            travelled += Math.abs(x) + Math.abs(y);
            if (before) {
                const after = spread();
                send('pan', {x: after.x - before.x, y: after.y - before.y});
                if (after.size > 0 && before.size > 0)
                    send('zoom', {x: after.x, y: after.y, factor: before.size / after.size});
            } else if (pointers.size === 1 && travelled > 3 * devicePixelRatio) {
                send(now.pan ? 'pan' : 'turn', {x, y});
            }
        });
        const askAt = (x, y) => {
            const place = {x: Math.floor(x), y: Math.floor(y)};
            send('pick', place);
            send('ask', place);
        };
        const up = (e) => {
            const p = pointers.get(e.pointerId);
            pointers.delete(e.pointerId);
            if (p && !p.pan && e.type === 'pointerup' && travelled <= 3 * devicePixelRatio)
                askAt(p.x, p.y);
        };
        canvas.addEventListener('pointerup', up);
        canvas.addEventListener('pointercancel', up);
        canvas.addEventListener('contextmenu', (e) => e.preventDefault());
        canvas.addEventListener('wheel', (e) => {
            if (!isActive)
                return;
            endHint();
            e.preventDefault();
            send('zoom', {...at(e), factor: Math.pow(1.0015, Math.max(-400, Math.min(400, e.deltaY)))});
        }, {passive: false});

        // The same by keys, where the picture has the focus.
        canvas.addEventListener('keydown', (e) => {
            const step = 20 * devicePixelRatio, middle = {x: canvas.width / 2, y: canvas.height / 2};
            const steps = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
            const [x, y] = steps[e.key] || [0, 0];
            const factor = {'+': 0.8, '=': 0.8, '-': 1.25}[e.key];
            if (e.ctrlKey || e.metaKey || e.altKey)
                return;
            if (x || y)
                send(e.shiftKey ? 'pan' : 'turn', {x, y});
            else if (factor)
                send('zoom', {...middle, factor});
            else if (e.key === 'Enter')
                askAt(middle.x, middle.y);
            else
                return;
            endHint();
            e.preventDefault();
        });

        // ---- Controls -----------------------------------------------------------------------------------------------

        $('play').onclick = () => setPlaying(!playing);
        $('time').oninput = () => { sliding = true; playing = false; $('play').textContent = 'Play';
                                    send('seek', {frame: +$('time').value}); };
        $('time').onchange = () => { sliding = false; };
        $('style').onchange = () => send('put', {name: 'style', values: $('style').value + '\n'});
        for (const [id, {button, close}] of Object.entries(panels)) {
            $(button).onclick = () => openPanel(id, $(id).hidden);
            $(close).onclick = () => openPanel(id, false);
        }
        $('undo').onclick = () => panel.undo();
        $('again').onclick = () => files.again(0);
        $('fit').onclick = () => send('fit');
        $('file').onchange = () => {
            files.open([...$('file').files]);
            $('file').value = ''; // else a browser tells no change where the same file is chosen again
        };
        addEventListener('dragover', (e) => e.preventDefault());
        addEventListener('drop', (e) => {
            e.preventDefault();
            endHint();
            files.openDropped(e.dataTransfer);
        });
        addEventListener('keydown', (e) => {
            const isTyped = e.target.closest('select, textarea, input:not([type=range]):not([type=checkbox])');
            const isUndo = (e.ctrlKey || e.metaKey) && !e.shiftKey && e.key === 'z';
            if (e.key === 'Escape' && shownPanel()) {
                openPanel(shownPanel(), false);
            } else if (e.key === 'Escape' && ask.hasPicks()) {
                ask.forget();
            } else if (isUndo && !panel.isEdited(e.target)) { // else the field's own
                panel.undo();
                e.preventDefault();
            }
            if (isTyped || e.ctrlKey || e.metaKey || e.altKey)
                return;
            if (e.key === ' ' && !e.target.closest('button, summary, input[type=checkbox]')) {
                setPlaying(!playing);
                e.preventDefault();
            }
            if (e.key === 'f')
                send('fit');
            for (const [id, {key}] of Object.entries(panels))
                if (e.key === key) {
                    openPanel(id, $(id).hidden);
                    e.preventDefault();
                }
            if (e.key === 'r')
                files.again(0);
            if (e.key === 'u')
                panel.undo();
        });

        resize();
        $('style').value = 'soft'; // a browser may keep what was there before
        if (!new URLSearchParams(location.search).has('empty')) {
            playsFirst = true;
            send('rate', {rate: 6}); // it has few frames
            files.open([new File([Uint8Array.from(atob($('shipped').textContent), (c) => c.charCodeAt(0))],
                                 'pour.lammpstrj.gz')]);
        }
    }

    const early = []; // messages that come before the library is there
    if (typeof document !== 'undefined')
        runPage();
    else if (self.name === 'cgt-engine') {
        self.onmessage = (event) => early.push(event);
        runEngine().catch((error) => self.postMessage({type: 'error', text: 'the library does not start: ' + error}));
    }
})();
