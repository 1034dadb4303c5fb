#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""below - the panels below the sheets, each shown for the first time, while editing and while simulating."""
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, main, new_file, until, urge  # noqa: E402

SELECTED = 23  # as AtspiStateType counts
PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Horn  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
RUNG
  | NO Motor | COIL Horn |
END_PROGRAM

PROGRAM Other LD
RUNG
  | NO Horn | COIL %QX0.2 |
END_PROGRAM
'''

# More tabs than fit, and a line that is wider than the page.
LISTS = ''.join('''
PROGRAM Sums%d IL
  (* %s*)
  LD Horn
  ST %%QX0.%d
END_PROGRAM
''' % (number, 'it has no room beside the panels ' * 4, number) for number in (3, 4, 5))


def listed(editor, text):
    """Waits until the instruction list has that line."""
    editor.tab('Instruction list')
    until(lambda: any(text in node.text() for node in editor.all('Instruction list', 'text')), 'the line ' + text)


def edits(screen):
    """a panel that comes to the front shows the name at the cursor (cross reference) or the sheet in front (list)"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.tab('Cross reference')
    editor.says('Main, rung 1, row 1, column A')
    assert not editor.all('Main, rung 2, row 1, column A'), 'another name is listed'
    editor.tab('Log')
    editor.click(editor.beside(editor.element('Rung 2, NO', 'Motor')))
    editor.tab('Cross reference')
    editor.says('Main, rung 2, row 1, column A')
    editor.keys('Insert')
    editor.says('Rung 3')
    editor.tab('Log')
    editor.to_sheet()
    editor.keys('shift+F12')  # without a name all uses are listed
    editor.find('There is no name at the cursor')
    until(lambda: editor.find('Cross reference', 'page tab').states >> SELECTED & 1, 'the cross reference')
    editor.says('Other, rung 1, row 1, column A')
    editor.keys('ctrl+z', 'ctrl+Page_Down')
    editor.element('NO', 'Horn')
    listed(editor, 'PROGRAM Other IL')
    editor.keys('ctrl+Page_Up')
    listed(editor, 'PROGRAM Main IL')


def simulates(screen):
    """a status chart first shown in the past has the values of then; the timing chart steps from there"""
    editor = Editor(screen, new_file(screen, PROJECT))
    editor.to_sheet()
    editor.keys('ctrl+t', 'space', 'ctrl+t', 'ctrl+t')
    editor.element('Rung 2, COIL', 'Horn', ', on')
    editor.keys('alt+Left', 'alt+Left')
    editor.says('PAST · scan 1')
    editor.element('Rung 1, COIL', 'Motor', ', off')
    editor.keys('ctrl+alt+w')
    editor.find('Start, New value', 'text')
    until(lambda: [node for node in editor.all(role='label') if node.name == '0'], 'the value of that scan')
    editor.tab('Timing chart')
    editor.click(editor.find('Show all recorded scans'))
    urge(lambda: editor.find('Timing chart, cursor').has(12), lambda: editor.click(editor.find('Timing chart, cursor')), 'the keys')
    editor.shot('below-past')
    editor.keys('Escape')
    editor.element('Rung 2, COIL', 'Horn', ', on')
    editor.tab('Status chart')
    until(lambda: [node for node in editor.all(role='label') if node.name == '1'], 'the value of now')


def chosen(screen):
    """the menu of a line in the timing chart, by pointer: a line is moved, one is removed; the chart has the keys again"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+t')
    editor.tab('Timing chart')
    area = editor.find('Timing chart, cursor')
    for line, word, lines in (1, 'Move up', ('Motor', 'Start', 'Horn')), (0, 'Remove', ('Start', 'Horn')):
        x, y, _, _ = editor.place(area)
        editor.click((x + 60, y + 20 + 22 * line), button=3)
        editor.find(word, 'menu item').press()
        until(lambda: not editor.all(word, 'menu item') and area.has(12), 'the keys in the chart')
        text = editor.save(path)
        assert 'VIEW\n' + ''.join('  timing %s\n' % name for name in lines) + 'END_VIEW\n' in text, text


def all_panels(screen):
    """a small window while simulating: tabs without room are only in a menu; the tab of the current panel is visible"""
    editor = Editor(screen, new_file(screen, PROJECT + LISTS))
    editor.to_sheet()
    assert not editor.all('All panels')
    editor.keys('ctrl+m')
    editor.find('Filter the variables')
    until(lambda: not editor.all('Find an element'), 'the left side to be folded')
    editor.keys('F4')
    more = editor.find('All panels')
    end = editor.place(more)[0]
    places = [(tab, editor.place(tab)) for tab in editor.all(role='page tab')]
    cut, (x, y, _, height) = next((tab, at) for tab, at in places if at[0] + 8 < end < at[0] + at[2])
    editor.click((x + 4, y + height // 2))
    for panel in 'Status chart', 'Scenarios':
        editor.tab(panel)
        editor.find({'Status chart': 'Write all new values', 'Scenarios': 'Expect the value at the cursor'}[panel])
        assert editor.place()[2] <= 1024, 'the window is %d px wide' % editor.place()[2]
    editor.keys('ctrl+Page_Down', 'ctrl+Page_Down')
    editor.find('Text of the program')
    editor.click(more)
    board = editor.find('Board', 'menu item')
    assert not editor.find(cut.name, 'page tab').states >> SELECTED & 1, 'a part of the tab %s is shown' % cut.name
    board.press()
    board = editor.find('Board', 'page tab')
    until(lambda: editor.place(board)[0] + editor.place(board)[2] <= editor.place(more)[0], 'the tab to be seen')
    editor.find('Run…', 'push button')
    editor.keys('ctrl+m')
    until(lambda: not editor.all('All panels'), 'room for all')
    # Beside a list the window was blank, and GTK said so.
    assert 'without a current allocation' not in editor.logged(), editor.logged()


def problem_room(screen, problems):
    """Opens a project with so many warnings. px of the panel below, and of the sheet."""
    declared = ''.join('  Unused%d : BOOL;\n' % number for number in range(problems))
    editor = Editor(screen, new_file(screen, 'RUNGBOARD 1\n\nVAR\n  In AT %%IX0.0 : BOOL;\n  Out AT %%QX0.0 : BOOL;\n%sEND_VAR\n\n'
                                     'PROGRAM Main LD\nRUNG\n  | NO In | COIL Out |\nEND_PROGRAM\n' % declared))
    editor.to_sheet()
    tab = editor.find('Problems %d' % problems, 'page tab')
    state = editor.find('%d warning' % problems, 'label')

    def room():
        return editor.place(state)[1] - editor.place(tab)[1]
    editor.click(tab)
    until(lambda: room() < 260, 'the panel to be open')
    until(lambda: 'Unused0' in ' '.join(node.name for node in editor.all('is declared but not used')), 'the first problem')
    editor.shot('below-problems-%d' % problems)
    time.sleep(0.3)
    found = room(), editor.place(editor.sheet())[3]
    row = editor.place(until(lambda: editor.all('"Unused0" is declared', 'label'), 'its row')[0])
    assert row[1] + row[3] <= editor.place(state)[1], 'the row is cut: %s' % (row,)
    editor.finish()
    return found


def short(screen):
    """a small window: the problems take the room of their rows, many of them not more than a share"""
    one, sheet = problem_room(screen, 1)
    assert one <= 135 and sheet >= 420, 'one problem takes %d px, the sheet has %d' % (one, sheet)
    many, sheet = problem_room(screen, 30)
    assert 170 <= many <= 230 and sheet >= 300, '30 problems take %d px, the sheet has %d' % (many, sheet)


all_panels.size = short.size = '1024x700x24'
edits.quick = 'editor-gtk/panels'


def alarms(screen):
    """an alarm of the running simulation is acknowledged with the pointer: its block and its row say so"""
    editor = Editor(screen, os.path.join(ROOT, 'ladders', 'compressed-air.rung'))
    editor.to_sheet()
    editor.keys('ctrl+t')
    editor.click(editor.find('Run', 'push button'))
    editor.tab('Alarms')
    editor.says('1 active, 1 to acknowledge')
    editor.click(editor.find('Acknowledge all', 'push button'))
    editor.says('1 active, 0 to acknowledge')
    editor.says('active, acknowledged')
    editor.shot('below-alarms')


main([edits, simulates, chosen, all_panels, short, alarms])
