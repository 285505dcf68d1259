// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// What the page gives away: the picture, movies, settings, and the lines by which cgt-render and Python make the same.
/* exported createOut */
function createOut({send, say, openSettings, page}) {
    const $ = (id) => document.getElementById(id);
    let frames = 0, settings = '';

    // ---- The same by others -----------------------------------------------------------------------------------------

    function copy(from, button) {
        const done = () => {
            button.textContent = 'Copied';
            setTimeout(() => { button.textContent = 'Copy'; }, 2000);
        };
        from.select();
        if (navigator.clipboard)
            navigator.clipboard.writeText(from.value)
                .then(done, () => say('this browser does not let the page copy', true));
        else if (document.execCommand('copy'))
            done();
    }
    $('copy-command').onclick = () => copy($('command'), $('copy-command'));
    $('copy-python').onclick = () => copy($('python'), $('copy-python'));

    // ---- Files ------------------------------------------------------------------------------------------------------

    function download(name, blob) {
        page.saved = {name, blob};
        const link = Object.assign(document.createElement('a'), {href: URL.createObjectURL(blob), download: name});
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    }
    $('save-settings').onclick = () => download('picture.settings', new Blob(['# libcgt\n' + settings]));
    $('load-settings').onchange = async () => {
        const [file] = $('load-settings').files;
        if (file)
            openSettings(file.name, await file.text());
        $('load-settings').value = '';
    };

    // ---- Pictures ---------------------------------------------------------------------------------------------------

    // What is asked for, or a sentence that says what is wrong.
    function readSize() {
        const text = $('out-size').value.trim(), found = /^(\d{1,5})\s*[x\u00d7]\s*(\d{1,5})$/.exec(text);
        const [width, height] = found ? found.slice(1).map(Number) : [$('picture').width, $('picture').height];
        if ((text && !found) || !width || !height || width * height > 2 ** 26)
            throw new Error('the size is pixels such as 1920x1080, at most 67 million of them');
        return {width, height};
    }
    function readNumber(id, what) {
        const entry = $(id), value = entry.valueAsNumber;
        if (!(value >= +entry.min && value <= +entry.max))
            throw new Error(`${what} must be a number from ${entry.min} to ${entry.max}`);
        return value;
    }
    const isRun = () => $('movie-kind').value === 'run';
    function readMovie() {
        const rate = readNumber('movie-rate', 'pictures a second'), size = readSize();
        const first = isRun() ? readNumber('movie-first', 'the first frame') : 0;
        const last = isRun() ? readNumber('movie-last', 'the last frame') : 0;
        if (last < first)
            throw new Error('the last frame comes before the first');
        return {kind: $('movie-kind').value, rate, first, last, frames, as: $('movie-as').value,
                degrees: readNumber('movie-degrees', 'degrees'),
                count: isRun() ? 0 : Math.max(1, Math.round(rate * readNumber('movie-seconds', 'seconds'))),
                width: Math.max(2, size.width & ~1), height: Math.max(2, size.height & ~1)}; // as encoders have it
    }
    function begin(asked) {
        try {
            const job = asked();
            $('out-refused').hidden = true;
            setBusy(true);
            show(0, 1);
            send('make', job);
        } catch (error) {
            refuse(error.message);
        }
    }
    function refuse(text) {
        $('out-refused').textContent = text;
        $('out-refused').hidden = !text;
    }
    function setBusy(on) {
        for (const id of ['save-picture', 'save-movie'])
            $(id).disabled = on || !frames;
        $('making').hidden = !on;
    }
    function show(done, of) {
        $('progress').value = done / of;
        $('progress-text').textContent = of > 1 ? `${done} of ${of} pictures` : 'one picture';
    }
    function showKind() {
        for (const element of document.querySelectorAll('[data-movie]'))
            element.hidden = element.dataset.movie !== $('movie-kind').value;
    }
    $('save').addEventListener('change', () => refuse(''));
    $('save-picture').onclick = () => begin(() => ({kind: 'picture', ...readSize()}));
    $('save-movie').onclick = () => begin(readMovie);
    $('cancel').onclick = () => send('cancel');
    $('movie-kind').onchange = () => {
        showKind();
        $('movie-degrees').value = isRun() ? 0 : 360;
    };

    return {
        // A run of so many frames is open.
        begin(count) {
            frames = count;
            const several = frames > 1;
            $('movie-kind').value = several ? 'run' : 'orbit';
            $('movie-kind').options[0].disabled = !several;
            for (const id of ['movie-first', 'movie-last'])
                $(id).max = frames - 1;
            $('movie-first').value = 0;
            $('movie-last').value = frames - 1;
            $('movie-kind').onchange();
            $('save-settings').disabled = false;
            setBusy(false);
        },
        progress: (m) => show(m.done, m.of),
        // A job has ended: with a file, by the user, or by an error.
        made(m) {
            setBusy(false);
            if (m.blob)
                download(m.name, m.blob);
            refuse(m.text || '');
            say(m.blob ? `${m.name}: ${(m.blob.size / 1e6).toFixed(2)} MB` : m.text ? m.text : 'cancelled', !!m.text);
        },
        // The settings of what is shown, and what makes the same.
        tell({text, command, python}) {
            settings = text;
            $('command').value = command;
            $('python').value = python;
        },
    };
}
