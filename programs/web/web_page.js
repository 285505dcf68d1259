// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// The page of cgt-web. Emscripten's createCgt stands before this text in one script, which runs three times: in the
// page, as the engine's worker, which owns the library, and as each of the library's threads, where nothing here runs.
(() => {
    'use strict';
    const script = typeof document !== 'undefined' ? document.currentScript.src : self.location.href;

    // Bytes, unpacked where they are gzip's.
    async function unpack(bytes) {
        const head = new Uint8Array(bytes, 0, Math.min(2, bytes.byteLength));
        if (head[0] !== 0x1f || head[1] !== 0x8b)
            return bytes;
        return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
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
        const packed = await fetch(new URL('cgt-web.wasm.gz', script));
        if (!packed.ok)
            throw new Error('no cgt-web.wasm.gz: ' + packed.status);
        const cgt = await createCgt({
            wasmBinary: await unpack(await packed.arrayBuffer()),
            poolSize: Math.max(1, threads - 1),
            mainScriptUrlOrBlob: script,
            locateFile: (name) => name.endsWith('.worker.js')
                ? URL.createObjectURL(new Blob([threadScript], {type: 'text/javascript'})) : new URL(name, script).href,
        });
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

        function show(milliseconds) {
            const bytes = 4 * width * height, pixels = cgt._web_pixels();
            const old = spare.pop(), buffer = old && old.byteLength === bytes ? old : new ArrayBuffer(bytes);
            pending++; // a picture cannot be made of shared memory: a copy
            new Uint8Array(buffer).set(new Uint8Array(cgt.HEAPU8.buffer, pixels, bytes));
            const frame = cgt._web_frame(), primitives = cgt._web_primitives();
            tell('picture', {buffer, width, height, frame, primitives, left, milliseconds}, [buffer]);
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

        // Events come between steps. While the page shows a picture the next is made, and no more.
        function run() {
            scheduled = false;
            if (pending > 1)
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

        function open(name, bytes) {
            playing = false;
            left = 0;
            const path = name.replace(/[^\w.-]/g, '_').replace(/^\.+/, '');
            for (const old of cgt.FS.readdir('/').filter((f) => f.includes('.') && f.length > 2))
                cgt.FS.unlink('/' + old);
            cgt.FS.writeFile('/' + path, new Uint8Array(bytes));
            const status = cgt.ccall('web_open', 'number', ['string'], [path]);
            isOpen = status === 0;
            outdated = isOpen;
            hasShadows = true;
            soft = 0;
            if (!isOpen)
                return fail();
            frames = cgt._web_frames();
            const columns = JSON.parse(cgt.UTF8ToString(cgt._web_columns()));
            tell('opened', {name, frames, columns});
            tellValues();
            for (let text; (text = cgt._web_warning());)
                tell('warning', {text: cgt.UTF8ToString(text)});
            return undefined;
        }

        const actions = {
            open: (m) => open(m.name, m.bytes),
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
            camera: () => tell('camera', {text: cgt.UTF8ToString(cgt._web_camera())}),
            memory: () => tell('memory', {bytes: cgt.HEAPU8.buffer.byteLength, used: cgt._web_used()}),
            shown: (m) => { pending--; spare.push(m.buffer); },
        };
        self.onmessage = (event) => {
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
            {ready: 0, first: 0, pictures: 0, left: 0, milliseconds: 0, error: '', picked: null};
        let playing = false, sliding = false, playsFirst = false, waiting = {};
        page.send = send;
        page.ask = (type, rest, answer) => new Promise((done) => { waiting[answer || type] = done; send(type, rest); });

        function say(text, isError) {
            page.error = isError ? text : '';
            $('message').textContent = text;
            $('message').className = isError ? 'error' : '';
        }
        const panel = createPanel($('panel'), {
            put: (name, values, isUndo) => send('put', {name, values, isUndo}),
            say,
        });
        function openPanel(on) {
            if (on && !panel.isBuilt())
                send('options');
            $('panel').hidden = !on;
            $('options').setAttribute('aria-expanded', on);
            if (on)
                $('close').focus();
            else
                $('options').focus();
        }
        function setPlaying(on) {
            playing = on;
            $('play').textContent = on ? 'Pause' : 'Play';
            send('play', {playing});
        }

        const actions = {
            ready: (m) => { page.ready = performance.now() - begin; page.threads = m.threads; },
            opened: (m) => {
                page.opened = m.name;
                panel.setColumns(m.columns);
                say(m.name + (m.frames > 1 ? ': ' + m.frames + ' frames' : ''));
                $('time').max = Math.max(0, m.frames - 1);
                for (const id of ['time', 'play'])
                    $(id).disabled = m.frames < 2;
                setPlaying(playsFirst && m.frames > 1 && !matchMedia('(prefers-reduced-motion: reduce)').matches);
                playsFirst = false;
            },
            warning: (m) => say(m.text),
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
                if (!sliding)
                    $('time').value = m.frame;
                $('frame').textContent = 'frame ' + m.frame + ', ' + m.primitives.toLocaleString('en') + ' primitives';
                send('shown', {buffer: m.buffer}, [m.buffer]);
            },
            picked: (m) => { page.picked = m.id; say(m.text || ''); },
            set: (m) => { if (m.text) say(m.text); },
            options: (m) => { if (!panel.isBuilt()) panel.build(m.rows); },
            values: (m) => {
                panel.update(m.values);
                if ('style' in m.values)
                    $('style').value = m.values.style.trim() || 'soft';
            },
            put: (m) => panel.answer(m),
            camera: () => {},
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

        async function openFile(name, file) {
            try {
                const packed = await file.arrayBuffer();
                let bytes = await unpack(packed);
                if (bytes !== packed)
                    name = name.replace(/\.gz$/i, '');
                if (/\.obj$/i.test(name)) {
                    bytes = framesOfObj(new TextDecoder().decode(bytes));
                    name = name.replace(/\.obj$/i, '.frames');
                }
                say('reading ' + name);
                send('open', {name, bytes}, [bytes]);
            } catch (error) {
                say(name + ': ' + error.message, true);
            }
        }
        page.open = (name, text) => openFile(name, new Blob([text]));

        // A mesh of Wavefront's as a .frames file of one frame: places, and polygons cut into fans.
        function framesOfObj(text) {
            const places = [], index = [];
            text.split('\n').forEach((line, number) => {
                const words = line.trim().split(/\s+/);
                const wrong = () => new Error('line ' + (number + 1) + ': not understood: ' + line.slice(0, 60));
                if (words[0] === 'v') {
                    if (words.length < 4 || words.slice(1, 4).some((w) => !isFinite(w)))
                        throw wrong();
                    places.push(+words[1], +words[2], +words[3]);
                } else if (words[0] === 'f') {
                    const corners = words.slice(1).map((w) => {
                        const k = parseInt(w, 10), at = k < 0 ? places.length / 3 + k : k - 1;
                        if (!(at >= 0 && at < places.length / 3))
                            throw wrong();
                        return at;
                    });
                    for (let k = 2; k < corners.length; k++)
                        index.push(corners[0], corners[k - 1], corners[k]);
                }
            });
            if (!index.length)
                throw new Error('there are no faces');
            const head = [2, 1, index.length / 3, 0];
            const bytes = new ArrayBuffer(8 + 16 + 4 * index.length + 4 + 4 * places.length);
            const view = new DataView(bytes);
            [...'CGTFRAM1'].forEach((c, i) => view.setUint8(i, c.charCodeAt(0)));
            let at = 8;
            const put = (x) => { view.setUint32(at, x, true); at += 4; };
            head.forEach(put);
            index.forEach(put);
            put(places.length / 3);
            places.forEach((x) => { view.setFloat32(at, x, true); at += 4; });
            return bytes;
        }

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
        const up = (e) => {
            const p = pointers.get(e.pointerId);
            pointers.delete(e.pointerId);
            if (p && !p.pan && e.type === 'pointerup' && travelled <= 3 * devicePixelRatio)
                send('pick', {x: Math.floor(p.x), y: Math.floor(p.y)});
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

        // ---- Controls -----------------------------------------------------------------------------------------------

        $('play').onclick = () => setPlaying(!playing);
        $('time').oninput = () => { sliding = true; playing = false; $('play').textContent = 'Play';
                                    send('seek', {frame: +$('time').value}); };
        $('time').onchange = () => { sliding = false; };
        $('style').onchange = () => send('put', {name: 'style', values: $('style').value + '\n'});
        $('options').onclick = () => openPanel($('panel').hidden);
        $('close').onclick = () => openPanel(false);
        $('undo').onclick = () => panel.undo();
        $('fit').onclick = () => send('fit');
        $('file').onchange = () => { for (const f of $('file').files) openFile(f.name, f); };
        addEventListener('dragover', (e) => e.preventDefault());
        addEventListener('drop', (e) => {
            e.preventDefault();
            endHint();
            for (const f of e.dataTransfer.files)
                openFile(f.name, f);
        });
        addEventListener('keydown', (e) => {
            const isTyped = e.target.closest('select, textarea, input:not([type=range]):not([type=checkbox])');
            const isUndo = (e.ctrlKey || e.metaKey) && !e.shiftKey && e.key === 'z';
            if (e.key === 'Escape' && !$('panel').hidden) {
                openPanel(false);
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
            if (e.key === 'o') {
                openPanel($('panel').hidden);
                e.preventDefault();
            }
            if (e.key === 'u')
                panel.undo();
        });

        resize();
        $('style').value = 'soft'; // a browser may keep what was there before
        if (!new URLSearchParams(location.search).has('empty')) {
            playsFirst = true;
            send('rate', {rate: 6}); // it has few frames
            openFile('pour.lammpstrj.gz',
                     new Blob([Uint8Array.from(atob($('shipped').textContent), (c) => c.charCodeAt(0))]));
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
