// SPDX-FileCopyrightText: 2026 The libcgt authors
// SPDX-License-Identifier: MIT
//
// The panel of cgt-web: a control for each row of the figure's table of options, in whose words its texts are. An
// option's values are a text with a line for each, as the engine has them: '' is not set, '\n' set without a value.
/* exported createPanel */
function createPanel(root, {put, load, say}) {
    const opened = ['Colours and light:', 'Style and light:', 'What is drawn:']; // what people change most
    const grey = '#808080'; // of colours without digits
    const most = 100; // changes that can be undone
    const fields = new Map(), changes = [];
    let columns = [], latest = {};

    function make(tag, properties, ...children) {
        const element = document.createElement(tag);
        for (const [name, value] of Object.entries(properties))
            if (name in element)
                element[name] = value;
            else
                element.setAttribute(name, value);
        element.append(...children);
        return element;
    }

    // The field for a value's text, by kind.
    function makeEntry(row, id) {
        const words = (row.words || '').split(' ').filter((word) => word);
        if (row.kind === 'word')
            return make('select', {id}, make('option', {value: ''}, 'default'),
                ...words.map((word) => make('option', {}, word)));
        if (row.repeats)
            return make('textarea', {id, rows: 1, placeholder: row.value, title: 'One value a line'});
        const isNumber = row.kind === 'number' || row.kind === 'whole';
        const entry = make('input', {id, type: isNumber ? 'number' : 'text', placeholder: row.value,
                                     autocomplete: 'off', spellcheck: false});
        if (isNumber)
            Object.assign(entry, {min: row.low, max: row.high, step: row.kind === 'whole' ? 1 : 'any'});
        return entry;
    }

    // A field's values, and the way back. Blanks around a text are its own.
    const strip = (f, text) => f.row.kind === 'text' ? text : text.trim();
    function read(f) {
        if (f.toggle && !f.toggle.checked)
            return '';
        const lines = f.entry ? f.entry.value.split('\n').map((line) => strip(f, line)).filter((line) => line) : [];
        return lines.length ? lines.join('\n') + '\n' : f.toggle ? '\n' : '';
    }
    function show(f, values) {
        f.values = values;
        if (f.toggle)
            f.toggle.checked = values !== '';
        if (f.entry)
            f.entry.value = strip(f, values.replace(/\n$/, ''));
        if (f.row.repeats)
            f.entry.rows = Math.max(1, Math.min(6, values.split('\n').length - 1));
        if (f.swatch)
            f.swatch.value = /^#?[0-9a-f]{6}$/i.test(values.trim()) ? '#' + values.trim().replace('#', '') : grey;
        f.reset.style.visibility = values === '' ? 'hidden' : 'visible';
        refuse(f, '');
    }
    function refuse(f, text) {
        f.refused.textContent = text;
        f.refused.hidden = !text;
        for (const control of [f.entry, f.toggle])
            if (control)
                control.setAttribute('aria-invalid', !!text);
        if (text)
            f.reset.style.visibility = 'visible'; // which also drops what was typed
    }
    function send(f) {
        const isWrong = f.entry && f.entry.validity.badInput; // a number field hides letters from everybody
        if (isWrong)
            refuse(f, f.row.name + ': not a number');
        else if (read(f) !== f.values || !f.refused.hidden)
            put(f.row.name, read(f));
    }

    function makeField(row) {
        const id = 'option-' + row.name, f = {row, values: ''};
        const control = make('div', {className: 'control'});
        if (row.kind === 'switch' || row.optional)
            f.toggle = make('input', {type: 'checkbox', id, onchange: () => send(f)});
        if (row.kind !== 'switch')
            f.entry = makeEntry(row, f.toggle ? id + '-value' : id);
        if (row.kind === 'color')
            f.swatch = make('input', {type: 'color', 'aria-label': row.name + ': choose a colour'});
        const reset = 'Reset ' + row.name;
        f.reset = make('button', {type: 'button', title: reset, 'aria-label': reset}, '\u00d7');
        f.refused = make('p', {className: 'refused', id: id + '-refused', role: 'alert', hidden: true});
        const help = make('p', {className: 'help', id: id + '-help', hidden: true}, row.help);
        const more = make('button', {type: 'button', 'aria-label': 'About ' + row.name, 'aria-expanded': false,
                                     'aria-controls': help.id}, '?');
        if (f.entry) {
            f.entry.onchange = () => {
                if (f.toggle)
                    f.toggle.checked = f.toggle.checked || f.entry.value !== '';
                send(f);
            };
            if (f.toggle)
                f.entry.setAttribute('aria-label', row.name + ', ' + row.value);
            if (f.entry.tagName === 'INPUT' && (row.words || offersColumns(row))) {
                f.list = make('datalist', {id: id + '-words'});
                f.entry.setAttribute('list', f.list.id);
            }
        }
        if (f.swatch)
            f.swatch.onchange = () => { f.entry.value = f.swatch.value.slice(1); f.entry.onchange(); };
        for (const part of [f.toggle, f.entry, f.swatch, f.list])
            if (part)
                control.append(part);
        for (const part of [f.toggle, f.entry])
            if (part)
                part.setAttribute('aria-describedby', f.refused.id + ' ' + help.id);
        f.reset.onclick = () => {
            if (f.values === '')
                show(f, '');
            else
                put(row.name, '');
            (f.toggle || f.entry).focus(); // the button hides
        };
        more.onclick = () => {
            help.hidden = !help.hidden;
            more.setAttribute('aria-expanded', !help.hidden);
        };
        fields.set(row.name, f);
        fillList(f);
        show(f, latest[row.name] || '');
        return make('div', {className: 'row', 'data-option': row.name},
            make('label', {htmlFor: id, title: row.help}, row.name), control, more, f.reset, f.refused, help);
    }

    const offersColumns = (row) => row.kind === 'formula' || /\b(BY|COLUMN|FORMULA)\b/.test(row.value || '');
    function fillList(f) {
        if (!f.list)
            return;
        const words = (f.row.words || '').split(' ').filter((word) => word);
        f.list.replaceChildren(...[...new Set([...words, ...(offersColumns(f.row) ? columns : [])])]
            .map((value) => make('option', {value})));
    }

    function undo() {
        const last = changes.pop();
        if (last && last.name)
            put(last.name, last.before, true);
        else if (last)
            load(last.before);
        document.getElementById('undo').disabled = !changes.length;
    }

    return {
        isBuilt: () => fields.size > 0,
        build(rows) {
            const groups = new Map();
            for (const row of rows) {
                if (!groups.has(row.group))
                    groups.set(row.group, make('details', {open: opened.includes(row.group)},
                        make('summary', {}, row.group.replace(/:$/, ''))));
                groups.get(row.group).append(makeField(row));
            }
            root.append(...groups.values());
        },
        setColumns(names) {
            columns = names;
            fields.forEach(fillList);
        },
        // What is set now. A field that was refused, or is being edited, keeps what stands in it.
        update(values) {
            latest = values;
            fields.forEach((f, name) => { if ((values[name] || '') !== f.values) show(f, values[name] || ''); });
        },
        // What became of a put.
        answer(m) {
            const f = fields.get(m.name);
            if (!m.text && !m.isUndo && m.before !== m.after) {
                changes.push({name: m.name, before: m.before});
                changes.splice(0, changes.length - most);
            }
            document.getElementById('undo').disabled = !changes.length;
            if (f && m.text && !m.isUndo)
                refuse(f, m.text);
            else if (f && !m.text)
                show(f, m.after);
            if (m.text && (m.isUndo || !f || root.hidden))
                say(m.text);
        },
        // What became of a settings file, which changes many options at once.
        loaded(m) {
            if (!m.isRefused && !m.isUndo)
                changes.push({name: '', before: m.before});
            document.getElementById('undo').disabled = !changes.length;
        },
        undo,
        // Whether a field holds what was not sent yet.
        isEdited(element) {
            for (const f of fields.values())
                if (f.entry === element)
                    return element.tagName !== 'SELECT' && read(f) !== f.values;
            return false;
        },
    };
}
