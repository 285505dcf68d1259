// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// Files that a user chooses or drops: which are the run, its topology, a mesh beside it, settings; and the last ones,
// which can be read again.
/* exported createFiles */
function createFiles({unpack, openRun, openSettings, say, told}) {
    const most = 8; // sets of files that are remembered
    const topologies = ['psf', 'prmtop', 'parm7', 'top'], parts = ['itp'], settings = ['settings', 'conf'];
    const bare = ['xtc', 'trr', 'dcd', 'nc', 'ncdf', 'ncrst']; // of which few say what their atoms are
    const others = { // first bytes of what the page cannot unpack
        'Zstandard': [0x28, 0xb5, 0x2f, 0xfd], 'xz': [0xfd, 0x37, 0x7a, 0x58, 0x5a, 0], 'bzip2': [0x42, 0x5a, 0x68],
        'LZ4': [0x04, 0x22, 0x4d, 0x18], 'zip': [0x50, 0x4b, 3, 4], 'compress': [0x1f, 0x9d]};
    let sets = []; // [{name, sources}], the last one first; a source is {name, get}
    let last = Promise.resolve();

    const endingOf = (name) => (/\.([^.]+)$/.exec(name) || ['', ''])[1].toLowerCase();
    const isOne = (list) => (file) => list.includes(endingOf(file.name));

    // Which of several files is what: {run, topology, mesh, settings}, lists of names but for the last three.
    function sort(files) {
        const rest = files.filter((f) => !isOne(parts)(f) && !isOne(settings)(f));
        const meshes = rest.filter((f) => f.isMesh), tops = rest.filter(isOne(topologies));
        const moving = rest.filter(isOne(bare));
        const structures = rest.filter((f) => !f.isMesh && !isOne([...topologies, ...bare])(f));
        const asked = files.filter(isOne(settings));
        const names = (list) => list.map((f) => f.name);
        const few = (list, what) => {
            if (list.length > 1)
                throw new Error(`only one of ${names(list).join(', ')} can be ${what}`);
            return list[0];
        };
        let run = moving, topology;
        if (moving.length) {
            topology = few(tops.length ? tops : structures, 'the topology of ' + moving[0].name);
            if (tops.length && structures.length)
                throw new Error(`only one of ${names([...tops, ...structures]).join(', ')} can be the topology of ` +
                                moving[0].name);
        } else {
            run = structures;
            topology = few(tops, 'the topology');
            if (topology && !run.length)
                [run, topology] = [[topology], undefined];
        }
        let mesh = few(meshes, 'the mesh');
        if (mesh && !run.length)
            [run, mesh] = [[mesh], undefined];
        if (!run.length && files.some(isOne(parts)))
            throw new Error('.itp files belong to a .top file: open it with them');
        return {run, topology, mesh, settings: few(asked, 'the settings')};
    }

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

    // Why a file cannot be read, in words for its user.
    function reason(error) {
        return {NotFoundError: 'is no longer there',
                NotReadableError: 'has changed since it was chosen, or is no longer there: choose it again',
                NotAllowedError: 'may not be read any more: choose it again'}[error.name] || error.message;
    }

    // The bytes of one file as the engine takes them.
    async function read({name, get}) {
        const given = name;
        try {
            const packed = await (await get()).arrayBuffer();
            const head = new Uint8Array(packed, 0, Math.min(6, packed.byteLength));
            for (const [kind, magic] of Object.entries(others))
                if (magic.every((byte, k) => head[k] === byte))
                    throw new Error(`is compressed by ${kind}, and the page unpacks gzip alone: unpack it first`);
            let bytes = await unpack(packed);
            const doubt = bytes.doubt ? `${name}: ${bytes.doubt}` : '';
            if (bytes !== packed)
                name = name.replace(/\.gz$/i, '');
            const isMesh = endingOf(name) === 'obj';
            if (isMesh) {
                bytes = framesOfObj(new TextDecoder().decode(bytes));
                name = name.replace(/obj$/i, 'frames');
            }
            return {name: name.replace(/[/\0\n]/g, '_').replace(/^-$/, '_'), bytes, doubt, isMesh,
                    given: given.replace(/\n/g, '_')};
        } catch (error) {
            throw new Error(`${name}: ${reason(error)}`);
        }
    }

    async function openNow(set) {
        try {
            const files = [];
            say('reading ' + set.name);
            for (const source of set.sources)
                files.push(await read(source));
            const found = sort(files), asked = found.settings && new TextDecoder().decode(found.settings.bytes);
            if (found.run.length) {
                sets = [set, ...sets.filter((other) => other.name !== set.name)].slice(0, most);
                told(sets.map((other) => other.name));
                const nameOf = (file) => file ? file.name : '';
                openRun({name: found.run[0].name, count: found.run.length, files, run: found.run.map(nameOf),
                         topology: nameOf(found.topology), mesh: nameOf(found.mesh),
                         doubt: files.map((f) => f.doubt).find((doubt) => doubt) || '',
                         given: {run: found.run.map((f) => f.given), topology: (found.topology || {given: ''}).given,
                                 mesh: (found.mesh || {given: ''}).given}});
            }
            if (found.settings)
                openSettings(found.settings.name, asked);
        } catch (error) {
            say(error.message, true);
        }
    }

    // One set after the other, in the order in which they were asked for.
    function open(sources) {
        if (sources.length) {
            const name = sources[0].name + (sources.length > 1 ? ` and ${sources.length - 1} more` : '');
            last = last.then(() => openNow({name, sources}));
        }
        return last;
    }

    return {
        open: (files) => open(files.map((file) => ({name: file.name, get: async () => file}))),
        // What was dropped: a handle, where the browser gives one, reads the file as it is at that time.
        async openDropped(transfer) {
            const files = [...transfer.files], items = [...transfer.items].filter((item) => item.kind === 'file');
            // asked for at once, since items end with the event
            const folders = items.map((item) => (item.webkitGetAsEntry() || {isDirectory: false}).isDirectory);
            const handles = await Promise.all(items.map((item) => item.getAsFileSystemHandle
                ? item.getAsFileSystemHandle().catch(() => null) : null));
            return open(files.map((file, k) => ({name: file.name, get: async () => {
                if (folders[k])
                    throw new Error('is a folder: open its files');
                return handles[k] && handles[k].kind === 'file' ? handles[k].getFile() : file;
            }})));
        },
        again: (index) => {
            if (sets[index])
                last = last.then(() => openNow(sets[index]));
        },
    };
}
