// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// What is this? The card that tells what was picked and measured, its marks on the picture, and the panel of
// selections: by a formula, whose spheres are then hidden, shown alone, labelled or followed.
/* exported createAsk */
function createAsk({send, put, valuesOf, hasOption, openPanel}) {
    const $ = (id) => document.getElementById(id);
    const faded = 0.15; // opacity of what is not selected
    const added = new Map(); // lines of options that this panel has set
    let picks = 0, formula = '', timer = 0, follows = false;

    function make(tag, properties, ...children) {
        const element = Object.assign(document.createElement(tag), properties);
        element.append(...children);
        return element;
    }

    // ---- The card ---------------------------------------------------------------------------------------------------

    // The formula for all spheres with this value of a column; '': it has a fraction, which seven digits do not hold.
    const alike = (column, value) => /^-?\d{1,7}$/.test(value) ? `${column} == ${value}`
        : isNaN(value) && !value.includes('"') ? `${column} == "${value}"` : '';

    // A pick's lines: the first is its name, the others have a column and its value.
    function makePick(pick, k, isOpen) {
        const [name, ...lines] = pick.lines.trim().split('\n');
        const rows = lines.map((line) => {
            const [column, value] = line.split(/ {2}(.*)/), same = column === 'at' ? '' : alike(column, value);
            const button = make('button', {textContent: 'all', title: `Select all with ${column} ${value}`,
                                           onclick: () => selectBy(same)});
            button.setAttribute('aria-label', button.title);
            return make('tr', {}, make('th', {scope: 'row'}, column), make('td', {}, value),
                make('td', {}, ...(same ? [button] : [])));
        });
        return make('details', {open: isOpen}, make('summary', {}, make('b', {className: 'mark'}, String(k + 1)), name),
            make('table', {}, make('tbody', {}, ...rows)));
    }

    function showPicks(m) {
        picks = m.picks.length;
        formula = m.formula;
        $('card').hidden = !picks;
        $('card-title').textContent = m.bond ? 'Bond' : picks > 1 ? `${picks} picked` : 'Picked';
        $('card-select').disabled = $('select-picked').disabled = !formula;
        $('measures').replaceChildren(...m.measures.map((measure) => {
            const numbers = [...Array(measure.count).keys()].map((k) => measure.first + k).join('\u2013');
            return make('li', {}, `${m.bond ? 'length' : measure.name} ${numbers}: `,
                make('b', {}, measure.value + (measure.known && measure.count > 2 ? '\u00b0' : '')));
        }));
        $('picks').replaceChildren(...m.picks.map((pick, k) => makePick(pick, k, k + 1 === picks)));
    }

    // Shares of the picture, two for each pick; negative where it is not seen.
    function showMarks(places) {
        while ($('marks').children.length > places.length / 2)
            $('marks').lastChild.remove();
        for (let k = 0; k < places.length / 2; k++) {
            const place = places.slice(2 * k, 2 * k + 2);
            if (!$('marks').children[k])
                $('marks').append(make('b', {className: 'mark'}, String(k + 1)));
            const mark = $('marks').children[k];
            mark.hidden = !place.every((share) => share >= 0 && share <= 1);
            [mark.style.left, mark.style.top] = place.map((share) => 100 * share + '%');
        }
    }

    $('card-close').onclick = () => { send('forgetPicks'); $('picture').focus(); };
    $('card-select').onclick = $('select-picked').onclick = () => selectBy(formula);

    // ---- Selections -------------------------------------------------------------------------------------------------

    const filter = $('filter'), actions = {
        hide: (text) => ['hide', /^[\w,]+$/.test(text) ? `(${text})` : text], // else 2 is a type
        isolate: (text) => ['show', text],
        fade: (text) => ['opacity', `not (${text})=${faded}`], label: (text) => ['label', text]};

    function select() {
        clearTimeout(timer);
        send('select', {formula: filter.value.trim()});
    }
    function selectBy(text) {
        filter.value = text;
        openPanel('select', true);
        select();
    }

    // How many a formula selects, or why it is refused.
    function showSelected(m) {
        if (m.formula !== filter.value.trim())
            return;
        const isRefused = m.count < 0, none = isRefused || !m.formula;
        $('filter-refused').textContent = isRefused ? m.text : '';
        $('filter-refused').hidden = !isRefused;
        filter.setAttribute('aria-invalid', isRefused);
        const [count, of] = [m.count, m.of].map((number) => number.toLocaleString('en'));
        $('selected').textContent = none ? '' : `${count} of ${of} selected`;
        $('label').hidden = !hasOption('label');
        for (const id of [...Object.keys(actions), 'follow'])
            $(id).disabled = none || !m.count;
    }

    function setFollows(on) {
        follows = on;
        $('follow').setAttribute('aria-pressed', on);
        $('follow').textContent = on ? 'Stop following' : 'Follow';
    }

    filter.oninput = () => { clearTimeout(timer); timer = setTimeout(select, 250); };
    filter.onchange = select;
    for (const [id, lineOf] of Object.entries(actions))
        $(id).onclick = () => {
            const [name, line] = lineOf(filter.value.trim());
            added.set(name, [...(added.get(name) || []), line]);
            put(name, valuesOf(name) + line + '\n');
        };
    $('follow').onclick = () => send('follow', {formula: follows ? '' : filter.value.trim()});
    $('show-all').onclick = () => {
        for (const [name, lines] of added) {
            const now = valuesOf(name), left = now.split('\n').filter((line) => line && !lines.includes(line));
            const values = left.map((line) => line + '\n').join('');
            if (values !== now)
                put(name, values);
        }
        added.clear();
        if (follows)
            send('follow', {formula: ''});
    };

    return {
        showPicks,
        showMarks,
        showSelected,
        hasPicks: () => picks > 0,
        forget: () => send('forgetPicks'),
        // What became of following.
        answerFollow(m) {
            setFollows(m.count > 0);
            if (m.count < 0) {
                $('filter-refused').textContent = m.text;
                $('filter-refused').hidden = false;
            }
        },
        // Another run is open: its columns, and which actions there are.
        begin(columns) {
            $('filter-columns').replaceChildren(...columns.map((value) => make('option', {value})));
            setFollows(false);
            showPicks({picks: [], measures: [], formula: ''});
            showMarks([]);
            select();
        },
    };
}
