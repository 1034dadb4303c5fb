#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""tree - the project's tree by keyboard and pointer: bookmarks, structure, names, files beside the project."""
import gettext
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, Editor, check, lines, main, new_file, sh, until  # noqa: E402
from outcome import drafts  # noqa: E402

TEXT = '''RUNGBOARD 1

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG
  | NO %IX0.0 | TON Delay PT:=T#1s | COIL %QX0.0 |
RUNG
  | NO %IX0.1 | COIL %QX0.1 |
END_PROGRAM

PROGRAM Other LD
RUNG
  | NO %IX0.2 | COIL %QX0.2 |
END_PROGRAM
'''
FIRST = '@print %QX0.0\n%IX0.0=1\n+999\n+1\n'
MARKED = '@print %QX0.1\n%IX0.1=1\n%IX0.1=0\n'
OTHER = '@print %QX0.2\n%IX0.2=1\n%IX0.2=0\n'


def bookmarks(screen):
    """a bookmark is set, saved, listed, visited, undone; messages of earlier steps are gone"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.keys('Down', 'ctrl+shift+b')
    until(lambda: editor.all('no bookmarks', 'label'), 'the message')
    editor.keys('ctrl+b')
    until(lambda: editor.all('Main, rung 2', 'label'), 'the bookmark in the tree')
    until(lambda: not editor.all('no bookmarks', 'label'), 'the end of the message')
    assert editor.save(path) == TEXT + '\nVIEW\n  bookmark Main 2\nEND_VIEW\n'
    check(path)
    assert lines(path, MARKED) == ['%QX0.1=1', '%QX0.1=0']
    editor.keys('Up')
    until(lambda: editor.all('Rung 1 ', 'label'), 'the first rung')
    editor.keys('ctrl+shift+b')
    until(lambda: editor.all('Rung 2 ', 'label'), 'the rung with the bookmark')
    editor.shot('bookmarks')
    editor.keys('ctrl+s')
    until(lambda: editor.all('Saved', 'label'), 'the message')
    editor.keys('ctrl+z')
    until(lambda: not editor.all('Saved', 'label'), 'the end of the message')
    assert editor.save(path) == TEXT
    check(path)
    assert lines(path, MARKED) == ['%QX0.1=1', '%QX0.1=0']


def charts_and_boards(screen):
    """status charts and boards of before stand in the tree; Enter opens a chart, a double click too, and a board is asked"""
    charts = 'VIEW\n  status-chart Inputs\n    watch auto %IX0.0\n    watch auto %IX0.1\n  status-chart Lamps\n    watch auto %QX0.2\nEND_VIEW\n'
    settings = os.path.join(screen.home, '.config', 'glib-2.0', 'settings')
    os.makedirs(settings)
    with open(os.path.join(settings, 'keyfile'), 'w') as out:
        out.write("[org/rungboard/Editor]\nboards=['unix:/nowhere/board', 'unix:']\n")
    path = new_file(screen, TEXT + '\n' + charts)
    editor = Editor(screen, path, GSETTINGS_BACKEND='keyfile', XDG_CONFIG_HOME=os.path.join(screen.home, '.config'))
    editor.find('Status charts', 'label')
    editor.find('Boards', 'label')
    editor.click(editor.find('Lamps', 'label'), count=2)
    until(lambda: [node for node in editor.all('New value') if node.name.startswith('%QX0.2')], 'the chart of the lamps')
    editor.shot('tree-charts')
    editor.click(editor.find('Inputs', 'label'))
    editor.keys('Return')
    until(lambda: [node for node in editor.all('New value') if node.name.startswith('%IX0.1')], 'the chart of the inputs')
    assert not [node for node in editor.all('New value') if node.name.startswith('%QX0.2')]
    assert editor.save(path) == TEXT + '\n' + charts if editor.all('not saved') else open(path).read() == TEXT + '\n' + charts
    editor.find('This computer', 'label')
    # A simulation goes on until the person has confirmed the board.
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.click(editor.find('unix:/nowhere/board', 'label'), count=2)
    until(lambda: [node for node in editor.asked() if node.text() == 'unix:/nowhere/board'], 'the board in the dialog')
    editor.shot('tree-board-asked')
    editor.keys('Escape')
    until(lambda: not [node for node in editor.asked() if node.text() == 'unix:/nowhere/board'], 'the dialog to close')
    editor.says('SIMULATION')
    editor.keys('ctrl+m')
    until(lambda: not editor.all('SIMULATION'), 'the simulation to end')
    editor.click(editor.find('unix:/nowhere/board', 'label'), count=2)
    editor.says('/nowhere/board')
    until(lambda: [node for node in editor.all('nowhere') if 'unix:' not in node.name], 'why it does not answer')
    editor.shot('tree-board')


class German(Editor):
    """The same, with the texts to look for in German."""

    def __init__(self, screen, *files, **env):
        self.said = gettext.translation('rungboard', os.path.join(BUILD, 'locale'), ['de'])
        super().__init__(screen, *files, LANGUAGE='de', **env)

    def shown_as(self, text):
        return self.said.gettext(text)


def notes(screen):
    """what stands beside a name is not cut while there is room between them"""
    text = 'RUNGBOARD 1\n' + ''.join('\nPROGRAM %s LD\n%sEND_PROGRAM\n' % (name, 'RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n' * 15)
                                    for name in ('Ii', 'illili', 'Silillill'))
    editor = German(screen, new_file(screen, text.replace('COIL %QX0.0', 'S %QX0.0')))
    until(lambda: len(editor.all('15 Strompfade', 'label')) == 3, 'the notes')
    widths = until(lambda: [node.box()[2] for node in editor.all('15 Strompfade', 'label')], 'their widths')
    editor.shot('tree-notes')
    assert max(widths) - min(widths) <= 2, widths


def by_name(screen):
    """commands of the tree's menu are found by name, too; impossible ones say why; a bookmark shows rung and title"""
    path = new_file(screen, TEXT.replace('RUNG\n  | NO %IX0.1', 'RUNG "Washing is over, all of it is dry"\n  | NO %IX0.1'))
    editor = Editor(screen, path)
    editor.keys('Down', 'ctrl+b')
    rung = editor.find('Main 2', 'label')
    title = editor.find('Washing is over, all of it is dry', 'label')
    until(lambda: editor.place(title)[2] > 80 and editor.place(rung)[2] >= 38 and
          editor.place(title)[0] + editor.place(title)[2] <= editor.place(rung)[0], 'both beside each other')
    editor.shot('bookmark-title')
    editor.list_commands()
    editor.type('function fun')
    until(lambda: editor.all('Nothing found', 'label') and not editor.all('New function', 'list item'), 'no command')
    editor.shot('commands-none')
    editor.keys('Return')
    until(lambda: not editor.all('Nothing found', 'label'), 'the end of the list')
    editor.list_commands()
    # Enter right behind the last letter runs the command for the typed text, not the one selected before.
    editor.type('new program (il')
    sh('xdotool', 'key', 'Return')
    until(lambda: [n for n in editor.all('Name', 'text') if n.text() == 'Program1' and n.has(12)], 'a name to be asked for')
    editor.keys('Return')
    until(lambda: editor.all('Program1', 'label'), 'the program in the tree')
    text = editor.save(path)
    assert 'PROGRAM Program1 IL\n' in text, text
    check(path)
    assert lines(path, MARKED) == ['%QX0.1=1', '%QX0.1=0']


def nothing_added(screen):
    """a program cannot be added to a file that cannot be read, with a message"""
    path = new_file(screen, TEXT.replace('PROGRAM Other LD', 'PROGRAM Other XX'))
    editor = Editor(screen, path)
    editor.command('new function block')
    editor.says('The file cannot be read as a program')
    editor.shot('nothing-added')
    assert open(path).read() == TEXT.replace('PROGRAM Other LD', 'PROGRAM Other XX')


def steps(screen):
    """undo and redo show their change: the program comes to the front, the cursor goes there, a message names the step"""
    many = ''.join('RUNG\n  | NO %%IX1.%d | COIL %%MX1.%d |\n' % (bit, bit) for bit in range(8)) * 3
    path = new_file(screen, TEXT.replace('END_PROGRAM\n\nPROGRAM Other', many + 'END_PROGRAM\n\nPROGRAM Other'))
    before = open(path).read()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'slash')
    editor.element('Rung 1, NC', '%IX0.0')
    editor.keys('ctrl+End')
    editor.says('Rung 26')
    editor.keys('ctrl+z')
    editor.says('Undone: Negate')
    editor.says('Rung 1 ')
    editor.element('Rung 1, NO', '%IX0.0')
    editor.keys('ctrl+End', 'ctrl+y')
    editor.says('Redone: Negate')
    editor.element('Rung 1, NC', '%IX0.0')
    editor.keys('ctrl+Page_Down')
    editor.element('Rung 1, NO', '%IX0.2')
    editor.keys('slash')
    editor.element('Rung 1, NC', '%IX0.2')
    editor.keys('ctrl+Page_Up')
    editor.element('Rung 1, NC', '%IX0.0')
    editor.keys('ctrl+z')
    editor.element('Rung 1, NO', '%IX0.2')
    editor.shot('steps')
    editor.keys('ctrl+z')
    editor.element('Rung 1, NO', '%IX0.0')
    assert not editor.all('\u2022 new.rung', 'label') and open(path).read() == before


def rows(screen):
    """a program shows its variables, F2 renames it, Delete deletes it, Ctrl+Z restores it"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.click([n for n in editor.all('Main', 'label') if n.name == 'Main'][0])
    editor.keys('shift+Right')
    until(lambda: editor.all('Delay', 'label'), 'its variables')
    editor.shot('structure')
    editor.brought('F2')
    editor.find('New name', 'text')
    editor.keys('ctrl+a')
    editor.type('Pump')
    editor.keys('Return')
    until(lambda: editor.all('Pump', 'label'), 'the new name')
    assert 'PROGRAM Pump LD' in editor.save(path)
    check(path)
    assert lines(path, FIRST) == ['%QX0.0=0', '%QX0.0=0', '%QX0.0=1']
    editor.click([n for n in editor.all('Other', 'label') if n.name == 'Other'][0])
    editor.keys('Delete')
    until(lambda: not editor.all('Other', 'label'), 'the program to be gone')
    assert 'Other' not in editor.save(path)
    assert lines(path, OTHER) == ['%QX0.2=0', '%QX0.2=0']
    editor.keys('ctrl+z')
    assert 'PROGRAM Other' in editor.save(path)
    check(path)
    assert lines(path, OTHER) == ['%QX0.2=1', '%QX0.2=0']


def of_others(screen):
    """a program in the middle is deleted: its own tab closes; restored, it is at its old place"""
    third = '\nPROGRAM Third LD\nRUNG\n  | NO %IX0.3 | COIL %QX0.3 |\nEND_PROGRAM\n'
    path = new_file(screen, TEXT + third)
    editor = Editor(screen, path)
    bottom = editor.find('Sheet').box()[1]

    def tabs():
        labels = [node for node in editor.all(role='label') if node.name in ('Main', 'Other', 'Third')]
        seen = [node for node in labels if node.box()[2] > 0 and bottom - 50 < node.box()[1] < bottom]
        return [node.name for node in sorted(seen, key=lambda node: node.box()[0])]
    until(lambda: tabs() == ['Main', 'Other', 'Third'], 'the three tabs')
    editor.click([n for n in editor.all('Other', 'label') if n.name == 'Other' and n.box()[0] < 200][0])
    editor.keys('Delete')
    until(lambda: tabs() == ['Main', 'Third'], 'the tab of Other to go')
    editor.shot('tree-of-others')
    assert editor.save(path) == TEXT[:TEXT.index('\nPROGRAM Other')] + third
    editor.keys('ctrl+z')
    until(lambda: [n for n in editor.all('Other', 'label') if n.name == 'Other'], 'the program again')
    assert tabs() == ['Main', 'Third'], tabs()
    assert editor.save(path) == TEXT + third
    editor.click([n for n in editor.all('Other', 'label') if n.name == 'Other' and n.box()[0] < 200][0])
    editor.keys('Return')
    until(lambda: tabs() == ['Main', 'Other', 'Third'], 'its tab between the others')
    check(path)


USED = TEXT.replace('  Delay : TON;', '  Delay : TON;\n  Hold  : Seal;').replace(
    '| NO %IX0.1 | COIL', '| NO %IX0.1 | Seal Hold | COIL') + """
FUNCTION_BLOCK Seal LD
VAR_INPUT
  IN : BOOL;
END_VAR
VAR_OUTPUT
  Q : BOOL;
END_VAR
RUNG
  | NO IN | COIL Q |
END_FUNCTION_BLOCK
"""


def used(screen):
    """Delete of a block that is used asks first: its uses are shown, or it is deleted with its boxes; one undo"""
    path = new_file(screen, USED)
    editor = Editor(screen, path)

    def row():
        return [n for n in editor.all('Seal', 'label') if n.name == 'Seal' and n.box()[0] < 200]
    editor.click(until(row, 'the block')[0])
    editor.brought('Delete')
    editor.says('It is used in 2 places')
    editor.says('Main: 2 places')
    editor.shot('tree-used')
    editor.answer('Show uses')
    until(lambda: editor.all('Seal', 'table row'), 'its uses')
    editor.shot('tree-uses')
    assert row()
    editor.click(row()[0])
    editor.brought('Delete')
    editor.answer('Delete anyway')
    until(lambda: not row(), 'the block to be gone')
    text = editor.save(path)
    assert 'Seal' not in text and '| NO %IX0.1 | COIL %QX0.1 |' in text, text
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == USED


def in_front(screen):
    """Delete of the program in front leaves the keys in the tree; the only one cannot be deleted, with the reason"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.click([n for n in editor.all('Main', 'label') if n.name == 'Main' and n.box()[0] < 200][0])
    until(lambda: not [n for n in editor.all('Sheet') if n.has(12)], 'the focus in the tree')
    editor.keys('Delete')
    until(lambda: not [n for n in editor.all('Main', 'label') if n.name == 'Main'], 'the program to be gone')
    editor.keys('Delete')
    editor.says('It cannot be deleted: a project has at least one program')
    editor.shot('tree-only')
    assert editor.save(path) == TEXT[:TEXT.index('PROGRAM Main')] + TEXT[TEXT.index('PROGRAM Other'):]
    check(path)
    assert lines(path, OTHER) == ['%QX0.2=1', '%QX0.2=0']
    editor.keys('ctrl+z')
    assert editor.save(path) == TEXT


def sheet_of(editor):
    """Waits until the visible sheet has the focus."""
    until(lambda: [n for n in editor.all('Sheet') if n.box()[2] > 0 and n.has(12)], 'the focus on its sheet')


def keys(screen):
    """a double click gives the keys to the sheet; typing right after Delete in the tree loses nothing"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.to_sheet()

    def row():
        return until(lambda: [n for n in editor.all('Other', 'label') if n.name == 'Other' and n.box()[2] > 0],
                     'its row')[0]
    editor.click(row(), count=2)
    sheet_of(editor)
    editor.keys('Insert', 'ctrl+Delete', 'ctrl+Delete')
    assert 'PROGRAM Other LD\nRUNG\nEND_PROGRAM' in editor.save(path)
    editor.click(row())
    until(lambda: not [n for n in editor.all('Sheet') if n.has(12)], 'the focus in the tree')
    editor.keys('ctrl+Delete')
    editor.keys('Delete', 'ctrl+s')
    until(lambda: 'Other' not in open(path).read(), 'it to be saved without the program')
    check(path)
    assert lines(path, MARKED) == ['%QX0.1=1', '%QX0.1=0']


def row_menu(editor, row):
    """Clicks a row and opens its menu once it has the keys."""
    editor.to_sheet()
    editor.click(row)
    until(lambda: not [n for n in editor.all('Sheet') if n.has(12)], 'the focus in the tree')
    editor.keys('Menu')


def menu_item(editor, name):
    """The focused item of an open menu."""
    return any(node.name == name and node.has(12) for node in editor.all(name, 'menu item'))


def menus(screen):
    """the menus of a row, a sheet and the window, by keyboard alone; Esc gives the keys back"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.to_sheet()
    for _ in range(2):
        editor.keys('F10')
        until(lambda: menu_item(editor, 'File'), 'the menu of the window')
        editor.keys('Escape')
        editor.to_sheet()
    editor.keys('ctrl+f')
    editor.type('%IX')
    editor.keys('F10')
    until(lambda: menu_item(editor, 'File'), 'the menu of the window')
    editor.keys('Escape')
    editor.focus_on('Find', 'text')
    editor.type('0.1')
    until(lambda: editor.find('Find', 'text').text() == '%IX0.1', 'the rest behind what was typed')
    editor.keys('Escape')
    editor.to_sheet()
    for key in 'Menu', 'shift+F10':
        editor.keys(key)
        until(lambda: menu_item(editor, 'Edit operand'), 'the menu of the sheet')
        editor.keys('Escape')
        editor.to_sheet()
    row_menu(editor, [n for n in editor.all('Other', 'label') if n.name == 'Other'][0])
    until(lambda: menu_item(editor, 'Duplicate…'), 'the menu of the row')
    editor.keys('Escape')
    until(lambda: not menu_item(editor, 'Duplicate…'), 'it to be gone')
    editor.keys('Up', 'Up')
    editor.focus_on('Programs')
    editor.keys('Menu')
    until(lambda: menu_item(editor, 'New program (LD)…'), 'the menu of the tree')
    editor.step_to(lambda: menu_item(editor, 'New function…'), 'Down', 'the row of a new function')
    editor.keys('Return')
    until(lambda: [n for n in editor.all('Name', 'text') if n.text() == 'Function1' and n.has(12)], 'a name to be asked for')
    editor.keys('Return')
    until(lambda: editor.all('Function1', 'label'), 'the function in the tree')
    sheet_of(editor)
    editor.entry('In')
    editor.entry('OUT Function1')
    text = editor.save(path)
    assert 'FUNCTION Function1 : BOOL LD' in text and '| NO In | COIL Function1 |' in text, text
    check(path)
    assert lines(path, OTHER) == ['%QX0.2=1', '%QX0.2=0']


def stop(screen):
    """Tab enters the tree once, arrows move in it; the focused row has its text as name and is visible"""
    path = new_file(screen, TEXT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.click(editor.find('Add, rename or delete', 'push button'))
    until(lambda: menu_item(editor, 'New program (LD)…'), 'the menu')
    editor.keys('Escape')
    until(lambda: not menu_item(editor, 'New program (LD)…'), 'the menu to be gone')
    editor.keys('Tab')
    editor.focus_on('Programs')
    editor.keys('Down', 'Down')
    node = editor.focus_on('Other, 1 rung')
    assert editor.known()[node.parent].name == node.name
    editor.shot('tree-stop')
    editor.keys('Up')
    editor.focus_on('Main, 2 rungs')
    editor.keys('Tab')
    editor.focus_on('Find an element')
    editor.keys('shift+Tab')
    editor.focus_on('Main, 2 rungs')
    editor.keys('shift+Tab')
    editor.focus_on('Add, rename or delete')
    editor.keys('Tab', 'Return')
    sheet_of(editor)
    editor.keys('Down', 'ctrl+Delete')
    until(lambda: editor.all('Main, 1 rung', 'list item'), 'another name of the row')


MORE = TEXT + """
(* the alarm *)
PROGRAM Third LD
RUNG
  | NO %IX0.3 | COIL %QX0.3 |
END_PROGRAM

FUNCTION Half : INT IL
VAR_INPUT
  A : INT;
END_VAR
  LD    A
  DIV   2
  ST    Half
END_FUNCTION
"""


def order(screen):
    """programs are moved by keys, menu and drag; each is one undo; their order is the order of running"""
    path = new_file(screen, MORE)
    editor = Editor(screen, path)
    parts = MORE.split('\n\n', 1)[1].removesuffix('\n').split('\nEND_PROGRAM\n\n')
    main_, other, third, half = [part + '\nEND_PROGRAM' for part in parts[:3]] + [parts[3]]

    def row(name):
        return [n for n in editor.all(name, 'label') if n.name == name and n.box()[0] < 200][0]

    def is_saved(*order):
        editor.save(path)
        assert open(path).read() == 'RUNGBOARD 1\n\n' + '\n\n'.join(order) + '\n', open(path).read()
    editor.click(row('Third'))
    editor.keys('alt+Up')
    editor.says('“Third” now runs after “Main” in each scan')
    is_saved(main_, third, other, half)
    editor.keys('alt+Up')
    editor.says('“Third” now runs first in each scan')
    editor.focus_on('Third')
    is_saved(third, main_, other, half)
    editor.keys('alt+Up')
    editor.says('It is the first one already')
    editor.shot('tree-order')
    editor.keys('ctrl+z')
    is_saved(main_, third, other, half)
    editor.keys('ctrl+z')
    is_saved(main_, other, third, half)
    editor.click(row('Main'))
    editor.keys('Menu')
    until(lambda: menu_item(editor, 'Duplicate…'), 'the menu of the row')
    editor.step_to(lambda: menu_item(editor, 'Move down'), 'Down', 'the entry')
    editor.keys('Return')
    editor.says('“Main” now runs after “Other” in each scan')
    is_saved(other, main_, third, half)
    x, y = editor.centre(row('Third'))
    editor.drag((x, y), (editor.centre(row('Other'))[0], editor.place(row('Other'))[1] + 2), look='tree-drag')
    editor.says('“Third” now runs first in each scan')
    is_saved(third, other, main_, half)
    editor.drag(row('Third'), row('Half'))  # functions are another list
    editor.keys('ctrl+z')
    is_saved(other, main_, third, half)
    check(path)


def made(screen):
    """a new program asks for its name and refuses a bad one; a duplicate has a free name; Esc makes nothing"""
    path = new_file(screen, MORE)
    editor = Editor(screen, path)

    def name_is(text):
        until(lambda: [n for n in editor.all('Name', 'text') if n.text() == text and n.has(12)], 'the name ' + text)

    def refused(text):
        until(lambda: [n for n in editor.all(text, 'label') if n.box()[2] > 0], 'the reason ' + text)
    editor.command('new program (sfc')
    name_is('Program1')
    editor.type('Main')
    refused('“Main” is a program or block of this project')
    editor.shot('tree-name-refused')
    editor.keys('Return')
    name_is('Main')
    editor.keys('ctrl+a')
    editor.type('end_var')
    refused('“end_var” is a word of the language')
    editor.keys('ctrl+a')
    editor.type('Wash cycle')
    refused('“Wash cycle” is not a name')
    editor.keys('ctrl+a')
    editor.type('Wash')
    editor.keys('Return')
    until(lambda: editor.all('Wash', 'label'), 'the chart in the tree')
    assert editor.save(path) == MORE + '\nPROGRAM Wash SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n'
    editor.keys('ctrl+z')
    assert editor.save(path) == MORE
    editor.click([n for n in editor.all('Half', 'label') if n.name == 'Half'][0])
    editor.keys('ctrl+d')
    name_is('Half_2')
    editor.shot('tree-duplicate')
    editor.keys('Return')
    until(lambda: editor.all('Half_2', 'label'), 'the copy in the tree')
    half = MORE[MORE.index('\nFUNCTION Half'):]
    assert editor.save(path) == MORE + half.replace('Half', 'Half_2')
    editor.keys('ctrl+z')
    editor.command('new subroutine')
    name_is('Routine1')
    editor.keys('Escape')
    until(lambda: not editor.all(role='dialog') and editor.focused(), 'the end of the dialog')
    assert editor.save(path) == MORE
    check(path)


def properties(screen):
    """properties of a program and of the project: shown, edited, refused at the entry, one undo each"""
    path = new_file(screen, MORE)
    editor = Editor(screen, path)
    editor.click([n for n in editor.all('Third', 'label') if n.name == 'Third'][0])
    window = editor.brought('alt+Return')
    for fact in 'in every scan, as number 3 of 3', '1 rung', 'Ladder (LD)':
        until(lambda: editor.all(fact, 'label'), fact)
    assert [n for n in editor.all('Comment', 'text') if n.text() == 'the alarm']
    editor.keys('ctrl+a')
    editor.type('Main')
    until(lambda: [n for n in editor.all('“Main” is declared already', 'label') if n.box()[2] > 0], 'the refusal')
    editor.shot('properties-refused')
    editor.keys('Return')
    editor.keys('ctrl+a')
    editor.type('Alarm')
    until(lambda: not [n for n in editor.all('is declared already', 'label') if n.box()[2] > 0], 'its end')
    editor.keys('Tab')
    editor.focus_on('Comment')
    editor.keys('ctrl+End', 'Return')
    editor.type('of the pump')
    editor.shot('properties-program')
    editor.find('Apply', 'push button').press()
    until(lambda: window not in editor.windows(), 'the end of the dialog')
    changed = MORE.replace('PROGRAM Third', 'PROGRAM Alarm').replace('(* the alarm *)', '(* the alarm\n   of the pump *)')
    assert editor.save(path) == changed, open(path).read()
    editor.keys('ctrl+z')
    assert editor.save(path) == MORE
    window = editor.brought(lambda: editor.command('project properties'))
    editor.type('Pumps')
    editor.keys('Tab')
    editor.focus_on('Author')
    editor.type('A. "Al" Miller')
    editor.shot('properties-project')
    editor.keys('Return')
    until(lambda: window not in editor.windows(), 'the end of the dialog')
    head = 'RUNGBOARD 1\nPROJECT "Pumps"\nAUTHOR "A. $"Al$" Miller"\n'
    assert editor.save(path) == MORE.replace('RUNGBOARD 1\n', head), open(path).read()
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == MORE


MOTOR = """RUNGBOARD 1

VAR
  FanM : Motor;
END_VAR

PROGRAM Main LD
RUNG
  | NO %IX0.0 | Motor FanM Wait:=T#2s | COIL %QX0.0 |
  | NO %IX0.1 | .Stop                 |
END_PROGRAM

FUNCTION_BLOCK Motor LD
VAR_INPUT
  Start : BOOL; (* begins *)
  Stop  : BOOL;
  Wait  : TIME := T#500ms;
END_VAR
VAR_OUTPUT
  Run  : BOOL;
  Late : BOOL;
END_VAR
RUNG
  | NO Start | NC Stop | COIL Run |
END_FUNCTION_BLOCK
"""


def interface(screen):
    """the pins of a block above its sheet: edited, added, moved, deleted, folded; the sheet keeps its keys"""
    path = new_file(screen, MOTOR)
    editor = Editor(screen, path)
    editor.click([n for n in editor.all('Motor', 'label') if n.name == 'Motor'][0], count=2)
    sheet_of(editor)
    until(lambda: editor.all('3 inputs, 2 outputs', 'label'), 'the summary')

    def cell(text):
        return until(lambda: [n for n in editor.all('Wait', 'text') if n.text() == text and n.box()[2] > 0],
                     'the cell with ' + text)[0]

    def pin(name):
        return until(lambda: [n for n in editor.all(name, 'text') if n.text() == name and n.box()[2] > 0],
                     'the cell of ' + name)[0]

    def said(text):
        until(lambda: [n for n in editor.all(text, 'label') if n.box()[2] > 0], 'the message ' + text)
    cell('T#500ms')
    editor.shot('interface')
    editor.click(cell('T#500ms'))
    editor.keys('ctrl+a')
    editor.type('1s')
    editor.keys('Return')
    assert editor.save(path) == MOTOR.replace('T#500ms', 'T#1s')
    editor.keys('ctrl+z')
    editor.click(cell('T#500ms'))
    editor.keys('ctrl+a')
    editor.type('2s')
    editor.keys('alt+Up')  # what is typed is set before its pin moves
    stop, old, wait = '  Stop  : BOOL;\n', '  Wait  : TIME := T#500ms;\n', '  Wait  : TIME := T#2s;\n'
    assert editor.save(path) == MOTOR.replace(stop + old, wait + stop), open(path).read()
    check(path)
    editor.keys('alt+Up')  # callers draw Wait first, but the power still goes to Start
    start = '  Start : BOOL; (* begins *)\n'
    assert editor.save(path) == MOTOR.replace(start + stop + old, wait + start + stop), open(path).read()
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    cell('T#500ms')
    editor.click(pin('Stop'))
    editor.keys('alt+Up')
    said('The power of the row is connected to “Start”')
    editor.shot('interface-refused')
    editor.find('Delete the selected row', 'push button').press()
    editor.reply('Cancel')
    until(lambda: not editor.all(role='dialog'), 'the end of the question')
    editor.find('Delete the selected row', 'push button').press()
    editor.reply('Delete anyway')
    until(lambda: editor.all('2 inputs, 2 outputs', 'label'), 'one pin less')
    editor.keys('ctrl+z')
    until(lambda: editor.all('3 inputs, 2 outputs', 'label'), 'the pin again')
    editor.click(pin('Stop'))
    editor.keys('ctrl+a')
    editor.type('Halt')
    editor.keys('Return')
    text = editor.save(path)
    assert '| NO Start | NC Halt | COIL Run |' in text and '.Halt' in text, text
    check(path)
    editor.keys('ctrl+z')
    sheet_of(editor)  # undo leads to what it changed
    assert editor.save(path) == MOTOR
    editor.click(cell('T#500ms'))
    until(lambda: cell('T#500ms').has(12), 'the keys in the cell')
    editor.keys('F6')
    sheet_of(editor)
    editor.click(editor.find('Interface', 'push button'))
    until(lambda: not [n for n in editor.all('Delete the selected row', 'push button') if n.box()[2] > 0], 'it to be folded')
    sheet_of(editor)
    editor.shot('interface-folded')


def pins_moved(screen):
    """pins move between the sides of a block, by keys and by the pointer, each in one step; a refusal is told there"""
    path = new_file(screen, MOTOR)
    editor = Editor(screen, path)
    editor.click([n for n in editor.all('Motor', 'label') if n.name == 'Motor'][0], count=2)
    sheet_of(editor)

    def summary(text):
        until(lambda: editor.all(text, 'label'), text)

    def pin(name):
        return until(lambda: [n for n in editor.all(name, 'text') if n.text() == name and n.box()[2] > 0],
                     'the cell of ' + name)[0]

    def handle(name):
        return until(lambda: [n for n in editor.all('Move %s (' % name) if n.box()[2] > 0], 'the handle of ' + name)[0]

    def upper(node):
        x, y, width, height = node.box()
        return x + width // 2, y + height // 4

    def on_side():
        """The places of the sides are there while a pin is dragged."""
        side = [n for n in editor.all('in and out', 'label') if n.name == 'in and out' and n.box()[2] > 0]
        if side:
            sh('xdotool', 'mousemove', *map(str, editor.centre(side[0])), 'sleep', '0.2')
        return bool(side)
    summary('3 inputs, 2 outputs')
    editor.click(pin('Wait'))
    editor.keys('alt+Down')  # the side between has no pin yet
    summary('2 inputs, 2 outputs, VAR_IN_OUT: 1')
    assert 'VAR_IN_OUT\n  Wait : TIME' in editor.save(path), open(path).read()
    editor.keys('ctrl+z')
    summary('3 inputs, 2 outputs')
    assert editor.save(path) == MOTOR
    editor.drag(handle('Wait'), upper(pin('Late')), look='pins-drag')
    summary('2 inputs, 3 outputs')
    assert '  Run  : BOOL;\n  Wait : TIME := T#500ms;\n  Late : BOOL;\n' in editor.save(path), open(path).read()
    editor.keys('ctrl+z')
    summary('3 inputs, 2 outputs')
    editor.drag(handle('Wait'), upper(pin('Late')), look='pins-side', ready=on_side)
    summary('2 inputs, 2 outputs, VAR_IN_OUT: 1')
    editor.keys('ctrl+z')
    summary('3 inputs, 2 outputs')
    editor.drag(handle('Start'), upper(pin('Late')))
    until(lambda: [n for n in editor.all('Start: Where the block is used, the power of its row is connected to “Start”', 'label')
                   if n.box()[2] > 0], 'the refusal below the pins')
    editor.shot('pins-refused')
    editor.keys('ctrl+s')
    editor.says('Saved')
    assert open(path).read().index('Start : BOOL; (* begins *)') < open(path).read().index('VAR_OUTPUT')


SHEETS = """RUNGBOARD 1

VAR
  R : INT;
END_VAR

PROGRAM Main LD
RUNG
  | NO %IX0.0 | Scaled X:=3 A:=2 OUT=>R |
END_PROGRAM

PROGRAM Wash SFC
  VAR
    Count : INT := 3; (* rinses left *)
  END_VAR

  INITIAL_STEP Start:
  END_STEP

  TRANSITION FROM Start TO Start := Count > 0; END_TRANSITION
END_PROGRAM

FUNCTION Scaled : INT IL
VAR_INPUT
  X : INT; (* raw *)
  A : INT;
END_VAR
  LD    X
  MUL   A
  ST    Scaled
END_FUNCTION
"""


def declares(screen):
    """what a list and a chart declare is edited above them, while a simulation runs, too; each kind; folded apart"""
    path = new_file(screen, SHEETS)
    editor = Editor(screen, path)

    def go(name):
        editor.click([n for n in editor.all(name, 'label') if n.name == name and n.box()[0] < 200][0], count=2)

    def cell(name, text):
        return until(lambda: [n for n in editor.all(name, 'text') if n.text() == text and n.box()[2] > 0],
                     'the cell %s with %s' % (name, text))[0]

    def fill(at, text):
        editor.click(at)
        editor.keys('ctrl+a')
        editor.type(text)
        editor.keys('Return')

    def seen(text):
        return [n for n in editor.all(text, 'label') if n.box()[2] > 0]
    go('Scaled')
    until(lambda: seen('2 inputs, 0 outputs'), 'the summary')
    fill(cell('A, Initial value', ''), '5')
    assert editor.save(path) == SHEETS.replace('  A : INT;', '  A : INT := 5;'), open(path).read()
    until(lambda: [n for n in editor.all('Text of the program', 'text') if 'A : INT := 5;' in n.text()], 'the text')
    editor.keys('ctrl+z')
    cell('A, Initial value', '')
    fill(cell('A, Kind', 'input'), 'sideways')
    until(lambda: seen('“sideways” is no kind'), 'the refusal')
    editor.shot('declares-refused')
    editor.keys('Escape')
    editor.click(cell('A, Kind', 'input'))
    editor.keys('ctrl+space')
    editor.choose('local')
    until(lambda: seen('A: 1 caller has an operand there'), 'the warning')
    editor.focus_on('A, Kind')  # its row has moved
    editor.shot('declares-kind')
    assert '  X : INT; (* raw *)\nEND_VAR\nVAR\n  A : INT;\nEND_VAR\n' in editor.save(path), open(path).read()
    editor.keys('ctrl+z')
    assert editor.save(path) == SHEETS
    go('Wash')
    header = until(lambda: [n for n in editor.all('Variables', 'push button') if n.box()[2] > 0], 'the heading')[0]
    assert not [n for n in editor.all('Count, Name', 'text') if n.box()[2] > 0], 'it is unfolded'
    until(lambda: [n for n in editor.all('Chart') if n.name == 'Chart' and n.has(12)], 'the focus on the chart')
    editor.keys('shift+Tab')
    editor.focus_on('Variables')
    editor.keys('space')
    fill(cell('Count, Initial value', '3'), '7')
    assert editor.save(path) == SHEETS.replace('INT := 3', 'INT := 7')
    editor.click(editor.find('Simulate'))
    until(lambda: editor.all('SIMULATION'), 'the simulation')
    fill(cell('Count, Name', 'Count'), 'Rinses')
    text = editor.save(path)
    assert '  Rinses : INT := 7; (* rinses left *)' in text and ':= Rinses > 0;' in text, text
    check(path)
    editor.shot('declares-chart')
    editor.click(header)
    until(lambda: not [n for n in editor.all('Rinses, Name', 'text') if n.box()[2] > 0], 'it to be folded')
    go('Scaled')
    cell('A, Kind', 'input')  # pins stay unfolded


def to_file(screen):
    """a block that is used moves to a new file, which the project includes; one undo restores both; a kill loses nothing"""
    path = new_file(screen, MOTOR)
    part = os.path.join(screen.home, 'drive.rung')
    motor = MOTOR[MOTOR.index('FUNCTION_BLOCK'):]
    rest = MOTOR.replace(motor, 'INCLUDE "drive.rung"\n')
    editor = Editor(screen, path)

    def row(name):
        return [n for n in editor.all(name, 'label') if n.name == name and 0 < n.box()[0] < 200]

    def move():
        editor.click(until(lambda: row('Motor'), 'the block in the tree')[0])
        editor.keys('Menu')
        until(lambda: editor.all('Move to file…', 'menu item'), 'the menu of the row')
        editor.step_to(lambda: menu_item(editor, 'Move to file…'), 'Down', 'the entry')
        editor.keys('Return')
        until(lambda: [n for n in editor.all('Name of the file', 'text') if n.has(12) and n.text() == 'Motor.rung'], 'the name')

    def titles():
        return [n.name for n in editor.all('drive.rung', 'label') if n.box()[0] > 200 and n.box()[1] < 100]
    move()
    editor.keys('ctrl+a')
    editor.type('new')
    until(lambda: [n for n in editor.all('The file exists.', 'label') if n.box()[2] > 0], 'the refusal')
    editor.shot('tree-move-refused')
    editor.keys('ctrl+a')
    editor.type('drive')
    editor.shot('tree-move')
    editor.keys('Return')
    editor.says('“Motor” is now in “drive.rung”, which this project includes')
    until(lambda: titles() == ['• drive.rung'], 'the page of the file, which is not saved')
    assert not os.path.exists(part) and open(path).read() == MOTOR
    editor.shot('tree-moved')
    editor.keys('ctrl+z')
    until(lambda: not titles(), 'the page to be closed')
    assert row('Motor') and not editor.all('• new.rung', 'label')
    editor.keys('ctrl+y')
    until(lambda: titles() == ['• drive.rung'], 'the page again')
    editor.keys('ctrl+s')  # in the page of the part: both are saved
    until(lambda: os.path.exists(part) and open(path).read() == rest, 'both files')
    assert open(part).read() == 'RUNGBOARD 1\n\n' + motor, open(part).read()
    check(path)
    editor.keys('ctrl+z', 'ctrl+s')
    until(lambda: not os.path.exists(part) and open(path).read() == MOTOR, 'both files as before')
    move()
    editor.keys('ctrl+a')
    editor.type('drive')
    editor.keys('Return')
    until(lambda: titles() == ['• drive.rung'], 'the page of the file')
    until(lambda: sorted((motor in text, 'INCLUDE "drive.rung"' in text) for text in (open(file).read() for file in drafts(screen))) ==
          [(False, True), (True, False)], 'drafts of both')
    editor.kill()
    editor = Editor(screen)
    editor.shot('tree-move-again')
    until(lambda: titles() == ['• drive.rung'] and row('Motor'), 'both drafts')
    editor.says('2 warnings')
    until(lambda: not editor.keys('ctrl+s') and os.path.exists(part) and open(path).read() == rest, 'both files')
    check(path)


def to_project(screen):
    """to a file with programs of its own a program moves with what it needs; a block that is used here is refused"""
    path = new_file(screen, MORE)
    other = os.path.join(screen.home, 'other.rung')
    with open(other, 'w') as out:
        out.write('RUNGBOARD 1\n\nPROGRAM There LD\nRUNG\n  | NO %IX1.0 | COIL %QX1.0 |\nEND_PROGRAM\n')
    there = open(other).read()
    third = MORE[MORE.index('\n(* the alarm'):MORE.index('\nFUNCTION Half')]
    editor = Editor(screen, path)
    row_menu(editor, until(lambda: [n for n in editor.all('Third', 'label') if n.name == 'Third'], 'its row')[0])
    until(lambda: editor.all('Move to file…', 'menu item'), 'the menu of the row')
    editor.step_to(lambda: menu_item(editor, 'Move to file…'), 'Down', 'the entry')
    editor.keys('Return')
    editor.give_path(other, lambda: editor.reply('Existing file…'), 'Move to file')
    until(lambda: not [n for n in editor.all('Third', 'label') if n.name == 'Third'], 'it to be gone here')
    assert editor.save(path) == MORE.replace(third, ''), open(path).read()
    assert open(other).read() == there + third, open(other).read()
    editor.keys('ctrl+z', 'ctrl+s')
    until(lambda: open(path).read() == MORE and open(other).read() == there, 'both files as before')


def beside(screen):
    """a scenario beside the file is opened from the tree, edited and saved"""
    path = new_file(screen, TEXT)
    scenario = os.path.join(screen.home, 'new.scn')
    with open(scenario, 'w') as out:
        out.write('scenario One\n')
    editor = Editor(screen, path)
    editor.click(editor.find('new.scn', 'label'), count=2)
    editor.into('new.scn')
    editor.keys('ctrl+End')
    editor.type('wait 1s')
    editor.keys('ctrl+s')
    until(lambda: open(scenario).read() == 'scenario One\nwait 1s', 'the scenario to be saved')
    editor.shot('scenario')
    assert open(path).read() == TEXT


def nothing_open(screen):
    """without a tab the window says how to open one"""
    editor = Editor(screen, new_file(screen, TEXT))
    editor.to_sheet()

    def tabs():
        """The titles are right of the tree, above their pages."""
        return len([node for node in editor.all(role='label') if node.name in ('Main', 'Other', 'Symbols') and
                    node.box()[0] > 230 and node.box()[1] < 100])
    said = 'Nothing is open. Double-click a program in the tree to open it.'
    for left in 2, 1, 0:  # Main, Other, Symbols
        assert not editor.all(said, 'label'), '%d more are open' % (left + 1)
        editor.keys('ctrl+shift+w')
        until(lambda: tabs() == left, '%d tabs' % left)
    x, y, width, height = editor.place(editor.find(said, 'label'))
    editor.shot('tree-nothing-open')
    main_row = [node for node in editor.all('Main', 'label') if node.name == 'Main'][0]
    editor.click(main_row, count=2)
    editor.to_sheet()
    assert not editor.all(said, 'label'), 'it is said over the sheet'
    left, top, wide, high = editor.place(editor.sheet())
    x, y = x + width // 2, y + height // 2  # a bar without tabs is a little lower
    assert left < x < left + wide and top < y < top + high, 'it stood elsewhere'
    editor.click((x, y))  # nothing covers the sheet
    editor.keys('ctrl+shift+w')
    editor.says(said)


main([bookmarks, charts_and_boards, notes, by_name, nothing_added, steps, rows, of_others, used, in_front, nothing_open, keys, menus, stop, order, made, properties, interface, pins_moved, declares, to_file, to_project, beside])
