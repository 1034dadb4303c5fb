#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""tasks - the page of the tasks: cells, rows that come, go and move, a project without a CONFIGURATION, what runs
when."""
import gettext
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, Editor, check, lines, main, new_file, sh, until  # noqa: E402

PROGRAMS = '''
PROGRAM Quick LD
RUNG
  | NO Door | COIL %QX0.0 |
END_PROGRAM

PROGRAM Lazy LD
RUNG
  | NO %IX0.1 | COIL %QX0.1 |
END_PROGRAM

PROGRAM Other LD
RUNG
  | NO %IX0.2 | COIL %QX0.2 |
END_PROGRAM
'''
PLANT = '''RUNGBOARD 1

CONFIGURATION Plant (* head *)
VAR_GLOBAL
  Door AT %IX0.0 : BOOL;
END_VAR
  RESOURCE Cpu ON LINUX (* the board *)
    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)
    TASK Slow (INTERVAL := T#20ms, PRIORITY := 2);
    PROGRAM A WITH Fast : Quick; (* first *)
    PROGRAM B WITH Fast : Lazy;
  END_RESOURCE
  PROGRAM C : Other; (* last *)
END_CONFIGURATION
''' + PROGRAMS
PLAIN = 'RUNGBOARD 1\n\nVAR\n  Door AT %IX0.0 : BOOL;\nEND_VAR\n' + PROGRAMS
PAIR = '''RUNGBOARD 1

VAR_GLOBAL
  Ticks, Sum : INT;
END_VAR
CONFIGURATION Plant
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  TASK Slow (INTERVAL := T#5ms, PRIORITY := 2);
  PROGRAM A WITH Fast : Count;
  PROGRAM B WITH Slow : Add;
END_CONFIGURATION

PROGRAM Count IL
  LD Ticks
  ADD 1
  ST Ticks
END_PROGRAM

PROGRAM Add IL
  LD 0
  ST Sum
Again:
  LD Sum
  ADD 1
  ST Sum
  LT 100
  JMPC Again
END_PROGRAM
'''
QUESTION = 'Its programs then run in each scan: Quick, Lazy.'


def cell(editor, name):
    return editor.find(name, 'text')


def put(editor, name, text):
    """Types a text into a cell."""
    editor.into(name)
    editor.keys('ctrl+a')
    editor.type(text)
    editor.keys('Return')


def shows(editor, name, value):
    until(lambda: cell(editor, name).text() == value, '%s to be "%s"' % (name, value))


def opened(screen, text=PLANT):
    path = new_file(screen, text)
    editor = Editor(screen, path)
    editor.command('priority')
    editor.find('Period or event')
    return editor, path


def is_saved(editor, path, *changes, text=PLANT):
    """Does the file have these changes and no other?"""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    editor.keys('ctrl+s')
    until(lambda: open(path).read() == text, 'the file:\n%s\nbut:\n%s' % (text, open(path).read()))


def table(screen):
    """cells are edited in place and refused in red; each edit changes its line of the file, and one undo takes it back"""
    editor, path = opened(screen)
    put(editor, 'Fast, Period or event', '10ms')
    shows(editor, 'Fast, Period or event', 'T#10ms')
    is_saved(editor, path, ('T#5ms', 'T#10ms'))
    put(editor, 'Fast, Period or event', '25h')
    editor.says('Fast, Period or event: "T#25h"')
    editor.shot('tasks-refused')
    editor.keys('Escape')
    until(lambda: not editor.all('Fast, Period or event: "'), 'the end of the message')
    put(editor, 'Slow, Period or event', 'Door')
    shows(editor, 'Slow, Kind', 'Event')
    put(editor, 'Slow, Watchdog', '1s')
    put(editor, 'Slow, Priority', '0')
    put(editor, 'B, Name', 'Second')
    is_saved(editor, path, ('T#5ms', 'T#10ms'), ('PROGRAM B', 'PROGRAM Second'),
             ('Slow (INTERVAL := T#20ms, PRIORITY := 2)', 'Slow (SINGLE := Door, PRIORITY := 0, WATCHDOG := T#1s)'))
    check(path)
    for _ in range(4):
        editor.keys('ctrl+z')
    shows(editor, 'Slow, Kind', 'Cyclic')
    editor.keys('ctrl+z')
    is_saved(editor, path)
    editor.click(cell(editor, 'Slow, Kind'))
    editor.keys('alt+Down')
    editor.find('Event when a variable becomes TRUE', 'list item')
    editor.keys('Down', 'Return')
    shows(editor, 'Slow, Period or event', 'Door')
    put(editor, 'Fast, Name', 'Quickly')
    is_saved(editor, path, ('INTERVAL := T#20ms', 'SINGLE := Door'), ('TASK Fast', 'TASK Quickly'), ('WITH Fast', 'WITH Quickly'))
    until(lambda: editor.all('Quickly, 5 ms', 'list item') and editor.all('Slow, on Door', 'list item'), 'the tasks in the tree')
    editor.click(editor.find('Slow, on Door', 'list item'), count=2)
    editor.focus_on('Slow, Name')
    editor.click(until(lambda: [n for n in editor.all('Each scan', 'label') if n.box()[0] < 200], 'the row in the tree')[0], count=2)
    editor.focus_on('Each scan, Period or event')


def rows(screen):
    """programs move by handle and key, tasks come and go; what a deletion takes along is said before"""
    editor, path = opened(screen)
    editor.drag(editor.find('Move A'), cell(editor, 'Slow, Name'), look='tasks-drag')
    is_saved(editor, path, ('A WITH Fast', 'A WITH Slow'))
    editor.keys('ctrl+z')
    is_saved(editor, path)
    editor.click(cell(editor, 'B, Name'))
    editor.keys('alt+Up')
    swapped = ('    PROGRAM A WITH Fast : Quick; (* first *)\n    PROGRAM B WITH Fast : Lazy;\n',
               '    PROGRAM B WITH Fast : Lazy;\n    PROGRAM A WITH Fast : Quick; (* first *)\n')
    is_saved(editor, path, swapped)
    editor.keys('alt+Down', 'alt+Down')
    is_saved(editor, path, ('B WITH Fast', 'B WITH Slow'))
    editor.click(cell(editor, 'C, Name'), button=3)
    until(lambda: editor.all('Open program'), 'the menu of the row')
    editor.shot('tasks-menu')
    editor.keys('Escape')
    for _ in range(3):
        editor.keys('ctrl+z')
    editor.click(cell(editor, 'Fast, Name'))
    editor.click(editor.find('Delete the task or remove the program', 'push button'))
    editor.says(QUESTION)
    editor.shot('tasks-delete')
    editor.answer('Delete')
    is_saved(editor, path, ('    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)\n', ''),
             (' WITH Fast', ''))
    editor.command('New task')
    editor.focus_on('Task1, Name')
    editor.type('Idle')
    editor.keys('Return')
    shows(editor, 'Idle, Priority', '3')
    editor.click(editor.find('Add program…', 'push button'))
    until(lambda: editor.all('Quick (now in Each scan)'), 'the programs')
    editor.keys('Down', 'Return')
    until(lambda: 'WITH Idle' in (editor.keys('ctrl+s') or open(path).read()), 'the program in the task')
    check(path)


def in_tree(editor, name):
    """The row of a task in the tree."""
    return until(lambda: [n for n in editor.all(name, 'label') if n.name == name and n.box()[0] < 200], 'the row %s in the tree' % name)[0]


def tree(screen):
    """a task is renamed and deleted in the tree by key and menu, in the table by the same keys; each is one step"""
    editor, path = opened(screen)
    editor.click(in_tree(editor, 'Fast'))
    editor.brought('F2')
    editor.type('2nd')
    editor.says('“2nd” is not a name')
    editor.keys('ctrl+a')
    editor.type('slow')
    editor.says('“slow” is declared already')
    editor.shot('tasks-rename')
    editor.keys('ctrl+a')
    editor.type('Quickly')
    editor.answer('Rename')
    renamed = ('TASK Fast', 'TASK Quickly'), ('WITH Fast', 'WITH Quickly')
    is_saved(editor, path, *renamed)
    editor.keys('ctrl+z')
    is_saved(editor, path)
    deleted = ('    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)\n', ''), (' WITH Fast', '')
    editor.click(in_tree(editor, 'Fast'))
    editor.keys('Delete')
    editor.says(QUESTION)
    editor.answer('Cancel')
    editor.keys('Menu')
    until(lambda: editor.all('Rename…', 'menu item'), 'the menu of the task')
    assert not editor.all('Duplicate…', 'menu item')
    editor.shot('tasks-tree-menu')
    # the pointer may be above another entry
    editor.step_to(lambda: any(node.has(12) for node in editor.all('Delete', 'menu item')), 'Down', 'the entry')
    editor.keys('Return')
    editor.says(QUESTION)
    editor.answer('Delete')
    is_saved(editor, path, *deleted)
    editor.keys('ctrl+z')
    is_saved(editor, path)
    in_tree(editor, 'Fast') # then the rows stay where they are
    editor.click(in_tree(editor, 'Each scan'))
    for key in 'F2', 'Delete':
        editor.keys(key)
        editor.says('“Each scan” is not a task')
    editor.click(cell(editor, 'Fast, Priority'))
    editor.keys('F2')
    editor.focus_on('Fast, Name')
    editor.type('Quickly')
    editor.keys('Return')
    is_saved(editor, path, *renamed)
    editor.keys('ctrl+z')
    is_saved(editor, path)
    for place, key in ('Move Fast', 'Delete'), ('Fast, Priority', 'ctrl+Delete'):
        editor.click(editor.find(place))
        editor.keys(key)
        editor.says(QUESTION)
        editor.answer('Delete')
        is_saved(editor, path, *deleted)
        editor.keys('ctrl+z')
        is_saved(editor, path)


def below_tasks(screen):
    """in the tree, programs below their tasks move by drag and by keys, as tasks do; each is one step"""
    editor, path = opened(screen)

    def unfold(name):
        editor.click(in_tree(editor, name))
        editor.focus_on(name)
        editor.keys('shift+Right')
    unfold('Fast')
    editor.drag(in_tree(editor, 'A'), in_tree(editor, 'Slow'), look='tasks-tree-drag')
    is_saved(editor, path, ('A WITH Fast', 'A WITH Slow'))
    slow = in_tree(editor, 'Slow')
    until(lambda: in_tree(editor, 'A').box()[1] > slow.box()[1], 'the program below its new task')
    editor.keys('ctrl+z')
    is_saved(editor, path)
    editor.click(in_tree(editor, 'B'))
    editor.focus_on('B, Lazy')
    editor.keys('alt+Up')
    is_saved(editor, path, ('    PROGRAM A WITH Fast : Quick; (* first *)\n    PROGRAM B WITH Fast : Lazy;\n',
                            '    PROGRAM B WITH Fast : Lazy;\n    PROGRAM A WITH Fast : Quick; (* first *)\n'))
    editor.focus_on('B, Lazy')
    editor.keys('alt+Down', 'alt+Down')
    is_saved(editor, path, ('B WITH Fast', 'B WITH Slow'))
    editor.shot('tasks-tree')
    editor.keys(*['ctrl+z'] * 3)
    is_saved(editor, path)
    editor.click(in_tree(editor, 'Fast'))
    editor.focus_on('Fast, 5 ms')
    editor.keys('alt+Down')
    is_saved(editor, path, ('    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)\n', ''),
             ('PRIORITY := 2);\n', 'PRIORITY := 2);\n    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)\n'))
    editor.focus_on('Fast, 5 ms')
    editor.keys('alt+Down')
    editor.says('This cannot be moved there')
    editor.keys('ctrl+z')
    is_saved(editor, path)
    editor.drag(in_tree(editor, 'Slow'), (editor.centre(in_tree(editor, 'Fast'))[0], editor.place(in_tree(editor, 'Fast'))[1] + 2))
    is_saved(editor, path, ('    TASK Slow (INTERVAL := T#20ms, PRIORITY := 2);\n', ''),
             ('    TASK Fast', '    TASK Slow (INTERVAL := T#20ms, PRIORITY := 2);\n    TASK Fast'))
    editor.keys('ctrl+z')
    editor.click(in_tree(editor, 'A'))
    editor.focus_on('A, Quick')
    editor.keys('Delete')
    is_saved(editor, path, ('    PROGRAM A WITH Fast : Quick; (* first *)\n', ''))
    unfold('Do not run')
    below = until(lambda: [n for n in editor.all('Quick', 'label') if n.box()[0] < 200][1:], 'the program that does not run')[0]
    editor.drag(below, in_tree(editor, 'Slow'))
    until(lambda: 'WITH Slow : Quick' in (editor.keys('ctrl+s') or open(path).read()), 'the program in the task')
    check(path)
    unfold('Each scan')
    until(lambda: in_tree(editor, 'C').box()[1] > in_tree(editor, 'Each scan').box()[1] and (
        editor.click(in_tree(editor, 'C')) or 'C, Other' in editor.focused().name), 'the program of each scan')
    editor.keys('Return')
    editor.says('Rung 1 · column A')
    editor.element('Rung 1, NO', '%IX0.2')


def last_program(screen):
    """the last program stays, and the page says why; a refused text and its reason stay when its row should move"""
    text = PLANT.replace('    PROGRAM B WITH Fast : Lazy;\n', '').replace('  PROGRAM C : Other; (* last *)\n', '')
    editor, path = opened(screen, text)
    put(editor, 'A, Name', '2nd')
    editor.says('A, Name: ')
    editor.keys('alt+Down')
    editor.says('A, Name: ')
    assert cell(editor, 'A, Name').text() == '2nd', cell(editor, 'A, Name').text()
    editor.keys('Escape')
    until(lambda: not editor.all('A, Name: '), 'the end of the message')
    put(editor, 'Slow, Priority', '7')
    shows(editor, 'Slow, Priority', '7')
    editor.click(cell(editor, 'A, Name'))
    editor.click(editor.find('Delete the task or remove the program', 'push button'))
    editor.says('At least one program must run')
    editor.shot('tasks-last')
    editor.keys('ctrl+z')
    until(lambda: not editor.all('At least one program must run'), 'the end of the message with the next version')
    is_saved(editor, path, text=text)


def implicit(screen):
    """a project without a CONFIGURATION runs all in each scan; the first change writes one, undo takes it away"""
    editor, path = opened(screen, PLAIN)
    editor.says('all of them run in each scan')
    shows(editor, 'Each scan, Period or event', 'T#10ms')
    editor.shot('tasks-implicit')
    put(editor, 'Each scan, Period or event', 'fast')
    editor.says('Each scan, Period or event: ')
    put(editor, 'Each scan, Period or event', '20 ms')
    shows(editor, 'Task1, Period or event', 'T#20ms')
    until(lambda: not editor.all('all of them run in each scan'), 'the end of the hint')
    is_saved(editor, path, ('END_VAR\n', '''END_VAR

CONFIGURATION Config
  TASK Task1 (INTERVAL := T#20ms, PRIORITY := 0);
  PROGRAM Quick WITH Task1 : Quick;
  PROGRAM Lazy WITH Task1 : Lazy;
  PROGRAM Other WITH Task1 : Other;
END_CONFIGURATION
'''), text=PLAIN)
    check(path)
    editor.keys('ctrl+z')
    is_saved(editor, path, text=PLAIN)
    editor.says('all of them run in each scan')


def picture(screen):
    """what runs when: lanes by priority; the pointer and the keys say what runs at a time; the picture zooms"""
    editor, path = opened(screen)
    fast = editor.find('Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms …', 'list item')
    slow = editor.find('Slow: priority 2, every 20 ms, at 0 s, 20 ms …', 'list item')
    editor.find('Each scan: behind all tasks, every 5 ms, at 0 s, 5 ms, 10 ms …', 'list item')
    editor.says('the first 40 ms; then everything repeats')
    assert editor.place(fast)[1] < editor.place(slow)[1]
    x, y, width, height = editor.place(slow)
    sh('xdotool', 'mousemove', str(x + width * 3 // 5), str(y + height // 2))
    until(lambda: editor.all('Fast, then Each scan', 'label') or editor.all('Fast, then Slow, then Each scan', 'label'),
          'what runs at the pointer')
    editor.shot('tasks-picture')
    editor.click(editor.find('WHAT RUNS WHEN'))
    editor.click((x + 20, y + height // 2))
    editor.focus_on('Slow: priority')
    editor.keys('Right')
    editor.says('At 0 s: Fast, then Slow, then Each scan')
    editor.keys('Right')
    editor.says('At 20 ms: Fast, then Slow, then Each scan')
    editor.click(editor.find('Zoom in', 'push button'))
    until(lambda: editor.find('Zoom out', 'push button').has(24), 'a part of the time')
    editor.shot('tasks-zoomed')
    put(editor, 'Slow, Period or event', '10ms')
    editor.find('Slow: priority 2, every 10 ms, at 0 s, 10 ms …', 'list item')
    assert lines(path, '@print %QX0.0\nDoor=1\n') is not None


def simulated(screen):
    """while simulating, the picture has the real runs over the plan, also late ones; it follows the time and the past"""
    editor, path = opened(screen)
    editor.keys('ctrl+t', 'ctrl+t', 'ctrl+t')
    editor.says('PAUSE')
    fast = editor.find('Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms … · 3 runs', 'list item')
    slow = editor.find('Slow: priority 2, every 20 ms, at 0 s, 20 ms … · 1 run', 'list item')
    editor.says('low, grey: planned · green: ran')
    editor.shot('tasks-live')
    x, y, width, height = editor.place(slow)
    editor.click((x + 20, y + height // 2))
    editor.focus_on('Slow: priority')
    editor.says('Slow: priority 2, every 20 ms, at 0 s, 20 ms … · 1 run')
    editor.keys('Left')
    editor.says('At 5 ms: Fast, then Slow, then Each scan')
    editor.keys('Return')  # the scan of that run
    editor.says('Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms … · 1 run')
    editor.shot('tasks-past')
    editor.keys('Escape', 'alt+End')
    editor.click(editor.find('Simulation settings', 'push button'))
    editor.focus_on('Period, ms')
    editor.keys('ctrl+a')
    editor.type('12')
    editor.keys('Tab')
    editor.says('Simulating · 12 ms')
    editor.keys('Escape')
    editor.keys(*['ctrl+t'] * 6)
    editor.find('Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms … · 9 runs, 8 left out', 'list item')
    x, y, width, height = editor.place(fast)
    editor.click((x + 20, y + height // 2))
    editor.keys('Left')
    until(lambda: editor.all('At 87 ms: Fast (7 ms late, 1 run left out), then ', 'label'), 'the late run')
    editor.shot('tasks-late')
    editor.keys('Escape', 'ctrl+m')
    editor.find('Fast: priority 1, every 5 ms, at 0 s, 5 ms, 10 ms …', 'list item')
    until(lambda: not editor.find('Zoom out', 'push button').has(24), 'the whole time of the plan')


def paced(screen):
    """with a speed of the board runs take time: the picture and its text say who interrupted whom"""
    editor, _ = opened(screen, PAIR)
    editor.keys('ctrl+t')
    editor.says('PAUSE')
    editor.click(editor.find('Simulation settings', 'push button'))
    editor.focus_on('Period, ms')
    editor.keys('Tab')
    editor.focus_on('Speed of the board, words/ms')
    editor.keys('ctrl+a')
    editor.type('1000')
    editor.keys('Tab')
    editor.shot('tasks-speed')
    editor.keys('Escape')
    editor.keys(*['ctrl+t'] * 10)
    slow = editor.find('Slow: priority 2, every 5 ms, at 0 s, 5 ms … · 3 runs, interrupted 1 time', 'list item')
    x, y, width, height = editor.place(slow)
    editor.click((x + 20, y + height // 2))
    editor.keys('Left')
    until(lambda: any(re.match(r'At 7 ms: Fast \(0\.0\d\d ms\), then Slow \(0\.[1-9]\d\d ms\)$', node.name)
                      for node in editor.all('At 7 ms: Fast (', 'label')), 'how long the runs took')
    editor.keys('Left')
    until(lambda: any('interrupted' in node.name for node in editor.all('At 6 ms: Fast', 'label')), 'who was interrupted')
    editor.shot('tasks-paced')


class German(Editor):
    """The same, with the texts to look for in German."""

    @staticmethod
    def said(text):
        return gettext.translation('rungboard', os.path.join(BUILD, 'locale'), ['de']).gettext(text)

    def shown_as(self, text):
        return self.said(text)


def narrow(screen):
    """1024 px in German, simulating: a column without any entry leaves, so that no text is cut; it comes back by the menu"""
    editor = German(screen, new_file(screen, PLANT), LANGUAGE='de')
    editor.to_sheet()
    editor.command('Tasks')  # the same word in German
    kind, watchdog = ('Fast, ' + editor.said(name) for name in ('Kind', 'Watchdog'))
    editor.find(kind)
    editor.keys('ctrl+m')
    editor.find('Columns')
    until(lambda: not editor.all(watchdog), 'the empty column to leave')
    editor.shot('tasks-narrow')
    said = editor.said('Cyclic')
    _, _, wide, high = editor.find(kind).box()
    assert wide >= len(said) * high / 4, (said, wide, high)
    editor.click(editor.find('Columns'))
    editor.find('Watchdog', 'menu item')
    editor.step_to(lambda: editor.find('Watchdog', 'menu item').has(12), 'Down', 'the column')
    editor.keys('Return')
    until(lambda: editor.all(watchdog), 'the column Watchdog')


narrow.size = '1024x700x24'

main([table, rows, tree, below_tasks, last_program, implicit, picture, simulated, paced, narrow])
