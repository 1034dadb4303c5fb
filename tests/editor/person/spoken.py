#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""spoken - what a screen reader announces: each usable widget has its own name."""
import os
import re
import subprocess
import sys

import dbus

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
TWO = PROJECT.replace('END_PROGRAM', '''RUNG
  | NO Start | NO Start | COIL Motor |
RUNG
  | NO Start | NO Start | COIL Motor |
END_PROGRAM''')
BOX = PROJECT.replace('  Motor', '  Parts : CTU;\n  Motor').replace(
    '  | NO Start | COIL Motor |', '  | NO Start | CTU Parts |' + ' NO Start |' * 25 + ' COIL Motor |\n  | NO Start | .R |')
CHART = '''RUNGBOARD 1

PROGRAM Main SFC
  VAR
    Start AT %IX0.0 : BOOL;
    Full  AT %IX0.1 : BOOL;
    Valve AT %QX0.0 : BOOL;
  END_VAR

  INITIAL_STEP Idle:
  END_STEP

  TRANSITION FROM Idle TO Fill := Start; END_TRANSITION

  STEP Fill:
    Valve(N);
  END_STEP

  TRANSITION FROM Fill TO Idle := Full; END_TRANSITION
END_PROGRAM
'''
HEARD = re.compile(r'path=(\S+);[^;]*; member=PropertyChange\n +string "accessible-description"\n.*\n.*\n'
                   r' +variant +string "(.+)"')
USED = [ROLES[role] for role in ('check box', 'combo box', 'menu item', 'spin button', 'page tab',
                                 'push button', 'table', 'table cell', 'text', 'toggle button', 'entry')]
SHOWN = ROLES['push button'], ROLES['label']  # the buttons whose tips name the step, and the status bar
ROWS = ROLES['list item'], ROLES['panel']  # the row, or its content

TWICE = re.compile(r'(.+) \1$')


def nameless(editor):
    """Visible widgets that can be used, or rows that can have the focus, without a name, with a class name or with
    one of another widget. Cells of lists are named by their content."""
    found = [node for top in (None, editor.palette) for node in editor.walk(top)
             if node.role in USED or node.role in ROWS and node.states >> 11 & 1]
    names = [node for node in found if not node.name or node.name.startswith(('Gtk', 'Adw', '_')) or
             TWICE.match(node.name)]
    return sorted({'%d %s' % (node.role, node.name) for node in names
                   if node.name != 'GtkColumnViewCell' and node.box()[2] > 0})


def described(editor, node):
    """The description that a reader adds to the name: the text of the tooltip."""
    try:
        return editor.bus.call_blocking(editor.name, node.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                        (A11Y + 'Accessible', 'Description'))
    except dbus.exceptions.DBusException:
        return ''  # the widget is gone


def tips(screen):
    """a tooltip is also the description of its widget, also when it changes: a tile, a button without a text"""
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
    modes = {node.name: node for node in editor.all(role='radio button')}
    assert sorted(modes) == ['Edit', 'Online', 'Simulate'], modes
    for key, chosen in ('ctrl+m', 'Simulate'), ('ctrl+m', 'Edit'):
        editor.keys(key)
        until(lambda: [name for name, node in sorted(modes.items()) if node.has(4)] == [chosen], chosen)
    for panel in 'Cross reference', 'Status chart', 'Timing chart', 'Scenarios', 'Alarms', 'Log', 'Board':
        editor.tab(panel)
        assert not nameless(editor), (panel, nameless(editor))
    editor.keys('ctrl+alt+s')
    until(lambda: editor.all('Add a symbol', 'push button')[0].box()[2] > 0, 'the symbols')
    assert not nameless(editor), nameless(editor)
    editor.keys('ctrl+h')
    until(lambda: any(node.name == 'Replace' and node.box()[2] > 0 for node in editor.all(role='push button')),
          'find and replace')
    assert not nameless(editor), nameless(editor)


def empty_texts(editor):
    """Labels of the status bar that are empty and announced."""
    bottom = editor.find('EDIT', 'label').box()[1]
    labels = [node for node in editor.all(role='label') if node.box()[2] >= 0 and node.box()[1] == bottom]
    return [node.name for node in labels if not node.text()]


def imported(screen):
    """the dialog of an import; in the status bar no empty labels"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    until(lambda: not empty_texts(editor), 'texts alone in the status bar')
    editor.keys('ctrl+alt+s')
    until(lambda: editor.all('Add a symbol', 'push button')[0].box()[2] > 0, 'the symbols')
    assert not empty_texts(editor), empty_texts(editor)
    editor.give_path(new_file(screen, 'Name,Type\nBell,BOOL\n', 'symbols.csv'),
                     lambda: editor.click(editor.find('Import a table (CSV)', 'push button')), 'Import symbols')
    editor.find('1 new, ', 'label')
    assert not nameless(editor), nameless(editor)
    buttons = [node.name for node in editor.all(role='push button') if node.name in ('Cancel', 'Import')]
    assert sorted(buttons) == ['Cancel', 'Import'], buttons
    editor.shot('spoken-import')
    editor.keys('alt+i')
    editor.find('Bell, Name', 'text')


def simulated(screen):
    """the same while simulating"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+m')
    until(lambda: editor.all('Start', 'check box'), 'the panel of the simulation')
    assert not nameless(editor), nameless(editor)


class Reader:
    """Collects what a screen reader announces: new descriptions of the focused widget on the accessibility bus."""

    def __init__(self, editor, name='Sheet'):
        self.editor, self.name = editor, name
        self.path = os.path.join(editor.screen.home, 'heard')
        with open(self.path, 'w') as out:
            self.monitor = subprocess.Popen(
                ['dbus-monitor', '--address', editor.screen.accessibility_address(),
                 "type='signal',interface='org.a11y.atspi.Event.Object'"], stdout=out, stderr=subprocess.DEVNULL)
        editor.screen.running.append(self.monitor)
        until(lambda: 'NameLost' in open(self.path).read(), 'the monitor to listen')

    def sheet(self):
        return until(lambda: [node for node in self.editor.all(self.name) if node.name == self.name], self.name)[0]

    def said(self):
        sheet = self.sheet().path
        return [text for path, text in HEARD.findall(open(self.path).read()) if path == sheet]

    def all(self, begin):
        """The widgets that have said a text with that begin."""
        return [path for path, text in HEARD.findall(open(self.path).read()) if text.startswith(begin)]

    def says(self, text, then=None):
        """Waits for the next announcement after @then."""
        before = len(self.said())
        if then:
            then()
        said = until(lambda: self.said()[before:], text)
        assert said == [text], (text, said)
        assert self.sheet().has(12), 'the focus went away'


def undone(screen):
    """undo and redo in a table and in the tree: what has the focus says the step, and a moment later no more"""
    editor = Editor(screen, new_file(screen, PROJECT + PROJECT[PROJECT.index('\nPROGRAM'):].replace('Main', 'Other')))
    reader = Reader(editor)
    editor.to_sheet()
    editor.keys('ctrl+alt+s')
    editor.click(until(lambda: editor.all('Start, Retain', 'check box'), 'the symbol')[0])
    for change in None, lambda: (editor.click(editor.find('Other', 'label')), editor.keys('alt+Up')):
        if change:
            change()
        for key, what in ('ctrl+z', 'Undone: '), ('ctrl+shift+z', 'Redone: '):
            until(lambda: editor.find('Undo' if key == 'ctrl+z' else 'Redo', 'push button').has(24), 'a step')
            editor.keys(key)
            editor.says(what)
            until(lambda: set(reader.all(what)) - {node.path for node in editor.walk() if node.role in SHOWN}, what)
            until(lambda: not [node for node in editor.walk() if node.has(12) and described(editor, node).startswith(what)], 'silence')


def at_cursor(editor):
    """The selected node; waits until there is exactly one."""
    def look():
        found = [node for node in editor.all('Rung ', 'table cell') if node.has(23)]
        return found[0] if len(found) == 1 else None
    return until(look, 'one cell at the cursor')


def shape(editor, name):
    """A shape of a chart."""
    return until(lambda: [node for node in editor.all(name, 'table cell') if node.name == name], name)[0]


def actions(node):
    return [str(action[0]) for action in node.ask('Action', 'GetActions')[0]]


def cursor(screen):
    """the cell that the cursor moves to: an element, a wire, an empty cell, in a new rung and a deleted one"""
    editor = Editor(screen, new_file(screen, TWO))
    editor.to_sheet()
    start = 'NO, closed while TRUE: Start, %IX0.0'
    until(lambda: described(editor, editor.sheet()) == 'Rung 1, ' + start + ', row 1, column A', 'the first cell')
    assert at_cursor(editor).name == 'Rung 1, ' + start
    reader = Reader(editor)
    reader.says('Rung 1, wire, row 1, column B', lambda: editor.keys('Right'))
    wire = at_cursor(editor)
    assert wire.name == 'Rung 1, wire, row 1, column B' and wire.role == ROLES['table cell'], wire.name
    at, sheet = wire.box(), editor.sheet().box()
    assert at[2] > 0 and sheet[0] < at[0] < sheet[0] + sheet[2] and sheet[1] < at[1] < sheet[1] + sheet[3], at
    reader.says('Rung 1, ' + start + ', row 1, column A', lambda: editor.click(editor.element('Rung 1', 'Start')))
    assert at_cursor(editor).name == 'Rung 1, ' + start and not editor.all('wire', 'table cell')
    reader.says('Rung 2, ' + start + ', row 1, column A', lambda: editor.keys('Down'))
    reader.says('Rung 2, ' + start + ', row 1, column B', lambda: editor.keys('Right'))  # the same name
    reader.says('Rung 3, empty cell, row 1, column A', lambda: editor.keys('Insert'))
    empty = at_cursor(editor)
    assert empty.name == 'Rung 3, empty cell, row 1, column A' and actions(empty) == ['cell.edit', 'cell.go']
    reader.says('Rung 3, empty cell, row 1, column B', lambda: editor.keys('Right'))
    reader.says('Rung 3, ' + start + ', row 1, column A', lambda: editor.keys('ctrl+Delete'))
    reader.says('Rung 2, ' + start + ', row 1, column A', lambda: editor.keys('Up'))
    reader.says('Rung 2, ' + start + ', row 1, column A', lambda: editor.keys('ctrl+Delete'))  # another element
    assert len(editor.cells()) == 5, editor.cells()


def edited(screen):
    """an element placed at the cursor, and its entry through assistive technology"""
    editor = Editor(screen, new_file(screen))
    editor.to_sheet()
    until(lambda: described(editor, editor.sheet()) == 'Rung 1, empty cell, row 1, column A', 'the empty cell')
    reader = Reader(editor)
    cell = at_cursor(editor)
    cell.ask('Action', 'DoAction', 'i', actions(cell).index('cell.edit'))
    editor.opened()
    editor.type('XYZ Foo')
    until(lambda: described(editor, editor.asked()[0]) == '“XYZ” is not the word of an element or block', 'the refusal')
    editor.keys('ctrl+a')
    editor.entry('NO %IX0.0')
    until(lambda: reader.said()[-1:] == ['Rung 1, empty cell, row 1, column B'], 'the next cell')
    assert at_cursor(editor).name == 'Rung 1, empty cell, row 1, column B'
    assert len(editor.cells()) == 1, editor.cells()
    reader.says('Rung 1, NO, closed while TRUE: %IX0.0, row 1, column A', lambda: editor.keys('Left'))
    reader.says('Rung 1, NC, closed while FALSE: %IX0.0, row 1, column A', lambda: editor.keys('slash'))
    reader.says('Rung 1, empty cell, row 1, column A', lambda: editor.keys('Delete'))
    for key, what in ('ctrl+z', 'Undone: '), ('ctrl+shift+z', 'Redone: '):
        before = len(reader.said())
        editor.keys(key)
        until(lambda: any(text.startswith(what) for text in reader.said()[before:]), what)


def boxes(screen):
    """each row of a block, columns behind Z; while simulating values are announced, each once"""
    editor = Editor(screen, new_file(screen, BOX))
    editor.to_sheet()
    until(lambda: described(editor, editor.sheet()), 'the first cell')
    reader = Reader(editor)
    editor.keys('Right')
    counter = until(reader.said, 'the block')[0]
    assert counter.startswith('Rung 1, CTU, ') and counter.endswith(', row 1, column B'), counter
    reader.says(counter.replace('row 1', 'row 2'), lambda: editor.keys('Down'))
    assert at_cursor(editor).name == counter.split(', row')[0], at_cursor(editor).name
    coil = 'Rung 1, COIL, TRUE while powered: Motor, %QX0.0'
    reader.says('Rung 1, empty cell, row 2, column AB', lambda: editor.keys('End'))
    reader.says(coil + ', row 1, column AB', lambda: editor.keys('Up'))
    editor.keys('ctrl+m')
    editor.element('COIL', 'off')
    start = 'Rung 1, NO, closed while TRUE: Start, %IX0.0'
    reader.says(start + ', open, row 1, column A', lambda: editor.keys('Home'))
    editor.keys('space')
    editor.element('Rung 1', 'Start', 'closed')
    until(lambda: reader.said()[-1:] == ['Start = TRUE'], 'the new value')  # by a key; others change silently


def chart(screen):
    """the step, condition and line that the cursor of a chart moves to; not that a step becomes active"""
    path = new_file(screen, CHART)
    editor = Editor(screen, path)
    until(lambda: editor.find('Chart').has(12), 'the focus on the chart')
    until(lambda: described(editor, editor.find('Chart')).startswith('Step Idle, initial'), 'the first step')
    reader = Reader(editor, 'Chart')
    condition = 'Transition 1, from Idle to Fill, condition Start'
    reader.says(condition, lambda: editor.keys('Down'))
    reader.says('Step Fill', lambda: editor.keys('Down'))
    reader.says('Fill does: N Valve', lambda: editor.keys('Right'))
    reader.says(condition, lambda: editor.click(shape(editor, condition)))
    reader.says('Step Fill', lambda: editor.keys('Down'))
    editor.keys('ctrl+t')
    editor.says('Simulating')
    shape(editor, 'Step Idle, initial, active')
    editor.click(until(lambda: editor.all('Start', 'check box'), 'the switch')[0])
    editor.keys('ctrl+t', 'ctrl+t')
    shape(editor, 'Step Fill, active')
    assert reader.said()[-1] == 'Step Fill', reader.said()
    reader.says('Step Idle, initial', lambda: editor.click(shape(editor, 'Step Idle, initial')))


if __name__ == '__main__':
    main([window, imported, simulated, tips, undone, cursor, edited, boxes, chart])
