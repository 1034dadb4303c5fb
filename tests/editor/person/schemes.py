#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""schemes - each key of each key scheme is pressed: the rung at the cursor, or the window, is what the key is for."""
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, main, new_file, until  # noqa: E402

NAMES = {'MICROWIN': 'microwin', 'GXWORKS': 'gxworks', 'LDMICRO': 'ldmicro'}
RUNG = 'RUNG\n  | NO Start | COIL Motor |\n'
PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
'''
KEYSYMS = {'Control': 'ctrl', 'Shift': 'shift', 'Alt': 'alt'}


def rows():
    """The rows of key_schemes.def: scheme, what, keys as xdotool names them; a list of one tuple for each key."""
    with open(os.path.join(ROOT, 'editor-gtk/kit/key_schemes.def')) as table:
        text = table.read()
    found = re.findall(r'^(?:KEYS|PUT)\((\w+),\s+"?(\w+)"?,\s+"([^"]+)"\)', text, re.MULTILINE)
    assert len(found) == len(re.findall(r'^(?:KEYS|PUT)\(', text, re.MULTILINE))
    for scheme, what, keys in found:
        for key in keys.split('|'):
            if key == '<Shift>equal':  # of other keyboards: with Shift this key is a plus here
                continue
            yield scheme, what, re.sub(r'<(\w+)>', lambda found: KEYSYMS[found[1]] + '+', key)


def opened(screen, scheme, text):
    """An editor with that scheme: a person has chosen it before."""
    folder = os.path.join(screen.home, '.config', 'glib-2.0', 'settings')
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, 'keyfile'), 'w') as settings:
        settings.write("[org/rungboard/Editor]\nkeys='%s'\n" % NAMES[scheme])
    path = new_file(screen, text)
    editor = Editor(screen, path, GSETTINGS_BACKEND='keyfile', XDG_CONFIG_HOME=os.path.join(screen.home, '.config'))
    editor.to_sheet()
    return editor, path


def place(editor):
    """Where the cursor is, as the status line says it."""
    return next((node.name for node in editor.all('column ', 'label') if node.name.startswith('Rung ')), '')


def restore(editor, before):
    """Undoes what a key did."""
    until(lambda: not editor.asked() or editor.keys('Escape'), 'the entry to be gone')
    until(lambda: editor.cells() == before or editor.keys('ctrl+z'), 'the rungs as they were')
    editor.to_sheet()
    editor.keys('ctrl+Home')
    editor.says('Rung 1 · column A')


def elements(editor, what):
    """The elements of the first rung that are called so."""
    return editor.all('Rung 1, %s, ' % what, 'table cell')


def takes(editor, what, operand):
    """Types into the entry that a key has opened, or takes what the entry proposes; the element comes."""
    until(lambda: editor.asked() or elements(editor, what), 'an entry or the element %s' % what)
    if editor.asked():
        if not until(editor.asked, 'the entry')[0].text():
            editor.type(operand)
        editor.keys('Return')
    until(lambda: elements(editor, what), 'the element ' + what)


def other_operand(editor):
    """The operand of the element at the cursor is in the entry."""
    assert until(editor.asked, 'the entry')[0].text() == 'Start'
    editor.keys('ctrl+a')
    editor.entry('Other')
    until(lambda: [name for name in editor.cells() if 'Rung 1, NO' in name and 'Other' in name], 'the other operand')


def simulated(editor):
    """The simulation runs; the program is edited again afterwards."""
    editor.says('SIMULATION')
    editor.keys('ctrl+m')
    until(lambda: not editor.all('SIMULATION'), 'the editor')


# What comes of a key of that verb.
ACTS = {
    'contact': lambda editor: takes(editor, 'NO', 'Other'),
    'coil': lambda editor: takes(editor, 'COIL', 'Other'),
    'block': lambda editor: takes(editor, 'RS', 'RS Latch'),
    'negate': lambda editor: until(lambda: elements(editor, 'NC'), 'the negated contact'),
    'delete': lambda editor: until(lambda: not elements(editor, 'NO'), 'the contact to be gone'),
    'rung_above': lambda editor: until(lambda: editor.all('Rung 4, NO'), 'another rung'),
    'rung_below': lambda editor: until(lambda: editor.all('Rung 4, NO'), 'another rung'),
    'edit_operand': other_operand,
    'next_problem': lambda editor: until(lambda: 'column A' not in place(editor), 'the place of a problem'),
    'sim_mode': simulated,
}


def wanted(editor):
    """What is looked for, in the bar that finds."""
    editor.keys('ctrl+f')
    editor.focus_on(role='text')
    editor.type('Motor')
    until(lambda: editor.all('of 3', 'label') or editor.all('3'), 'what is found')
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('ctrl+Home')
    editor.says('Rung 1 · column A')


def scheme(screen, name):
    """Presses each key of a scheme."""
    keys = [row for row in rows() if row[0] == name]
    assert keys
    editor, _ = opened(screen, name, PROJECT + 3 * RUNG + 'END_PROGRAM\n')
    editor.keys('ctrl+Home')
    before = editor.cells()
    assert len(before) == 6, before
    for _, what, key in keys:
        if what == 'wire_here':
            continue  # see gaps()
        try:
            press(editor, what, key)
            restore(editor, before)
        except AssertionError as wrong:
            raise AssertionError('%s, %s for %s: %s' % (name, key, what, wrong))
    editor.shot('scheme-' + name)


def picture(editor):
    """How the first contact looks, without the frame of the cursor."""
    x, y, width, height = editor.place(elements(editor, 'NO')[0])
    return subprocess.run(['import', '-window', 'root', '-crop', '%dx%d+%d+%d' % (width - 8, height // 2, x + 4, y + 4),
                           '-depth', '8', 'rgb:-'], capture_output=True, check=True).stdout


def press(editor, what, key):
    """Presses one key, and waits for what it is for."""
    if what in ('find_next', 'find_previous'):
        wanted(editor)
        if what == 'find_previous':
            editor.keys('ctrl+End')
            until(lambda: place(editor).startswith('Rung 3'), 'the last rung')
        at = place(editor)
        editor.keys(key)
        until(lambda: place(editor) not in ('', at), 'what is found')
    elif what == 'show_as':
        seen = picture(editor)
        editor.keys(key)
        until(lambda: picture(editor) != seen, 'other texts above the elements')
    elif what == 'set_value':
        editor.keys('ctrl+m')
        editor.says('SIMULATION')
        editor.keys(key)
        editor.focus_on(role='text')
        editor.keys('Escape')
        editor.to_sheet()
        editor.keys('ctrl+m')
        until(lambda: not editor.all('SIMULATION'), 'the editor')
    else:
        editor.keys(key)
        ACTS.get(what, lambda editor: takes(editor, what, 'Other'))(editor)


def gaps(screen):
    """the keys of LDmicro that close gaps with wires"""
    for _, what, key in rows():
        if what == 'wire_here':
            editor, path = opened(screen, 'LDMICRO', PROJECT + RUNG.replace('| COIL', '|  | COIL') + 'END_PROGRAM\n')
            editor.keys('ctrl+Home', 'Right')
            editor.says('Rung 1 · column B')
            editor.keys(key)
            until(lambda: editor.all('no problems'), 'the gap to be closed by ' + key)
            assert '|  |' not in editor.save(path)
            editor.finish()


def micro_win(screen):
    """each key of Micro/WIN"""
    scheme(screen, 'MICROWIN')


def gx_works(screen):
    """each key of GX Works"""
    scheme(screen, 'GXWORKS')


def ldmicro(screen):
    """each key of LDmicro"""
    scheme(screen, 'LDMICRO')


ldmicro.quick = 'editor-gtk/kit'
main([micro_win, gx_works, ldmicro, gaps])
