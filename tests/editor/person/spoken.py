#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""spoken - what a screen reader says of the window: everything that can be used has a name of its own."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, ROLES, Editor, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL; (* push button *)
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
'''
USED = [ROLES[role] for role in ('check box', 'combo box', 'menu item', 'spin button', 'page tab',
                                 'push button', 'table', 'table cell', 'text', 'toggle button', 'entry')]


def nameless(editor):
    """What can be used and is seen, and has no name or that of a class. Cells of lists have what is in them."""
    found = [node for node in editor.all() if node.role in USED]
    found += [node for node in editor.walk(editor.palette) if node.role in USED]
    names = [node for node in found if not node.name or node.name.startswith(('Gtk', 'Adw', '_'))]
    return sorted({'%d %s' % (node.role, node.name) for node in names
                   if node.name != 'GtkColumnViewCell' and node.box()[2] > 0})


def described(editor, node):
    """What a reader says after the name: what the tooltip shows."""
    return editor.bus.call_blocking(editor.name, node.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                    (A11Y + 'Accessible', 'Description'))


def tips(screen):
    """what a tooltip shows describes its widget, also what changes: a tile, a button without a text"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    assert 'closed while FALSE' in described(editor, editor.tile('NC'))
    undo = editor.find('Undo', 'push button')
    assert described(editor, undo) == 'Undo', described(editor, undo)
    editor.keys('Insert')
    until(lambda: described(editor, undo).startswith('Undo: '), 'the name of the step')
    editor.keys('ctrl+z')
    until(lambda: described(editor, undo) == 'Undo', 'nothing to be undone')


def window(screen):
    """sheet, palette, tree, symbols, find and replace, each panel below"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    assert not nameless(editor), nameless(editor)
    for panel in 'Cross reference', 'Status chart', 'Timing chart', 'Scenarios', 'Log', 'Board':
        editor.tab(panel)
        assert not nameless(editor), (panel, nameless(editor))
    editor.keys('ctrl+alt+s')
    until(lambda: editor.all('Add a symbol', 'push button')[0].box()[2] > 0, 'the symbols')
    assert not nameless(editor), nameless(editor)
    editor.keys('ctrl+h')
    until(lambda: any(node.name == 'Replace' and node.box()[2] > 0 for node in editor.all(role='push button')),
          'find and replace')
    assert not nameless(editor), nameless(editor)


def simulated(screen):
    """the same while it simulates"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+m')
    until(lambda: editor.all('Start', 'check box'), 'the panel of the simulation')
    assert not nameless(editor), nameless(editor)


main([window, simulated, tips])
