#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""words - typing: a list with completion and undo, a word that goes in parallel, messages."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until, urge  # noqa: E402

LIST = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL; (* the green button *)
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main IL
  LD    Start
  ST    Motor
END_PROGRAM
'''


UNKNOWN = '''RUNGBOARD 1

PROGRAM Main LD
RUNG "Delay"
  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |
END_PROGRAM
'''


def file_with(screen, text):
    path = new_file(screen)
    with open(path, 'w') as out:
        out.write(text)
    return path


def a_list(screen):
    """a list: typed text goes into the file, a word is completed, Ctrl+Z undoes it"""
    path = file_with(screen, LIST)
    editor = Editor(screen, path)
    editor.click(until(lambda: editor.all('Text of the program', 'text'), 'the list')[0])
    editor.keys('ctrl+End', 'Up', 'Up', 'Up', 'End', 'Return')
    editor.type('ANDN Mo')
    editor.keys('ctrl+space')
    editor.shot('list-words')
    editor.keys('Return')
    text = editor.save(path)
    assert 'ANDN  Motor' in text, text
    check(path)
    assert lines(path, '@print Motor\nStart=1\n.\nStart=0\n') == ['Motor=1', 'Motor=0', 'Motor=0']
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    assert editor.save(path) == LIST
    check(path)
    assert lines(path, '@print Motor\nStart=1\n.\nStart=0\n') == ['Motor=1', 'Motor=1', 'Motor=0']
    editor.keys('ctrl+End', 'Up', 'Up', 'End', 'Return')
    editor.type('LD Nobody')
    editor.shot('list-wrong')
    until(lambda: editor.all('Nobody', 'label'), 'what is wrong')


def wrong_lines(screen):
    """a wrong line of a list: the problem has its line, Ctrl+. goes there; also behind END_PROGRAM"""
    path = file_with(screen, LIST)
    editor = Editor(screen, path)
    editor.click(until(lambda: editor.all('Text of the program', 'text'), 'the list')[0])
    editor.keys('ctrl+End', 'Up', 'Up', 'End', 'Return')
    editor.type('FOO')
    editor.find('"FOO" is not a known word. Main, line 4', 'table row')
    editor.keys('ctrl+Home', 'ctrl+period')
    editor.type('X')
    editor.find('"XFOO" is not a known word. Main, line 4', 'table row')
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    until(lambda: not editor.all(', line 4'), 'no problem')
    editor.keys('ctrl+End', 'Return')
    editor.type('what is this')
    editor.find('"what" is not a known word. Main, line 6', 'table row')
    editor.keys('ctrl+Home', 'ctrl+period')
    editor.type('X')
    editor.find('"Xwhat" is not a known word. Main, line 6', 'table row')
    editor.shot('list-wrong-lines')


MANY = 'RUNGBOARD 1\n\nPROGRAM Main LD\n%sEND_PROGRAM\n' % ''.join(
    'RUNG\n  | NO Lost%d | COIL %%QX%d.0 |\n' % (i, i) for i in range(30))


def next_problem(screen):
    """Ctrl+. says the problem that it goes to; its row is visible and selected"""
    editor = Editor(screen, new_file(screen, MANY))
    editor.to_sheet()
    editor.find('Error: "Lost7" is not declared. Main, rung 8', 'table row')
    for _ in range(24):
        editor.keys('ctrl+period')
    editor.says('Error: "Lost2')
    until(lambda: [node for node in editor.all('Error: "Lost', 'table row') if node.has(23)], 'a row that is chosen')
    editor.shot('problems-next')


UNUSED = '''RUNGBOARD 1

CONFIGURATION Plant
  PROGRAM A : Main;
END_CONFIGURATION

VAR
  Start AT %IX0.0 : BOOL;
  Tab   : INT;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
VAR
  Own : INT;
END_VAR
RUNG
  | NO Start | COIL Motor |
END_PROGRAM

SUBROUTINE Sub LD
RUNG
  | NO Start | COIL %QX0.1 |
END_SUBROUTINE

PROGRAM Spare LD
RUNG
  | NO Start | COIL %QX0.2 |
END_PROGRAM
'''


def next_place(screen):
    """a problem in a subroutine or a program opens it, one of a symbol its row of the table: Ctrl+., a double click"""
    editor = Editor(screen, new_file(screen, UNUSED))
    editor.to_sheet()
    rows = ['"Tab" is declared but not used. Symbols', '"Own" is declared but not used. Main, symbols',
            '"Sub" is a subroutine that is never called. Sub', '"Spare" does not run: the configuration has no PROGRAM line for it. Spare']
    for row in rows:
        editor.find(row, 'table row')

    def there(row):
        if 'Tab' not in row and 'Own' not in row:
            editor.focus_on('Sheet')
            editor.element('%QX0.1' if 'Sub' in row else '%QX0.2')
        else:
            editor.focus_on('Tab, Name' if 'Tab' in row else 'Own, Name', 'text')
    for row in rows:
        editor.click(editor.find(row, 'table row'), count=2)
        there(row)
    for row in rows + rows:
        editor.keys('ctrl+period')
        editor.says(row)
        there(row)
    editor.shot('problems-next-place')


def in_parallel(screen):
    """OR X is placed below the element at the cursor; the status bar says the next keys"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.entry('Start')
    editor.entry('OUT Motor')
    editor.keys('Home')
    until(lambda: editor.all('Negate', 'label'), 'what the next key does')
    editor.entry('OR Motor')
    text = editor.save(path)
    assert 'NO Motor ^|' in text, text
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\nStart=0\n') == ['Motor=0', 'Motor=1', 'Motor=1']


def pointed_at(screen):
    """the tooltip of an element has name, address, type and comment; of a wrong one, why"""
    path = file_with(screen, LIST.replace('Main IL', 'Main LD').replace(
        '  LD    Start\n  ST    Motor\n', 'RUNG\n  | NO Start | NO Nobody | COIL Motor |\n'))
    editor = Editor(screen, path)
    editor.click(editor.grid(50, 0))
    sh('xdotool', 'mousemove_relative', '3', '3')
    until(lambda: [n for n in editor.all('Start · %IX0.0 · BOOL', 'label')
                   if 'the green button' in n.name], 'what is known of Start')
    editor.shot('tooltip')
    x, y = editor.grid(50, 1)
    sh('xdotool', 'mousemove', str(x), str(y), 'mousemove_relative', '3', '3')
    until(lambda: [n for n in editor.all('Nobody', 'label') if 'Error: ' in n.name], 'why it is wrong')


def other_keys(screen):
    """a key scheme of another editor takes effect at once"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.keys('ctrl+comma')
    editor.focus_on('Light or dark')
    for row in 'Contrast', 'Colour of power', 'Above an element', 'Addresses', 'Fold long rungs':
        editor.keys('Tab')
        editor.focus_on(row)
    editor.keys('Tab', 'Tab')  # by the switch of that row
    editor.focus_on('Key scheme')
    editor.keys('Return')
    editor.choose('LDmicro')
    editor.shot('preferences')
    # The first Escape may close the list, if that has not closed yet.
    urge(lambda: not editor.all('Key scheme'), lambda: editor.keys('Escape'), 'the preferences to be gone')
    editor.to_sheet()
    editor.keys('c')
    editor.opened()
    editor.entry('Start')
    editor.keys('l')
    editor.opened()
    editor.entry('Motor')
    editor.keys('Home', 'n')
    text = editor.save(path)
    assert '| NC Start | COIL Motor |' in text, text
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=1', 'Motor=0']


def window_keys(screen):
    """a key of the window takes the text of the entry, then acts; a wrong text stays"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('Start')
    assert 'NO Start |' in editor.save(path)
    editor.gone()
    editor.keys('F7')  # its line is empty: nothing was begun
    editor.opened()
    editor.keys('ctrl+f')
    until(lambda: editor.all('Find', 'text'), 'the bar that finds')
    editor.lines |= {node.path for node in editor.all(role='text') if 'Find' in node.name}
    editor.gone()
    editor.focus_on(role='text')
    editor.keys('Escape')
    editor.to_sheet()
    editor.type('OUT')
    editor.keys('ctrl+s')
    until(lambda: editor.all('operand is still missing', 'label'), 'what is missing')
    editor.shot('window-keys')
    assert editor.asked() and 'COIL' not in open(path).read()
    editor.type(' Motor')
    editor.keys('ctrl+shift+z', 'ctrl+z')  # a key of the entry does nothing on the sheet
    editor.keys('ctrl+a')
    editor.type('OUT Motor')
    assert '| NO Start | COIL Motor |' in editor.save(path)
    editor.gone()
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def again(screen):
    """an entry that opens again has no text, candidate or undo of the last one"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('TON')
    editor.opened()
    editor.keys('Down', 'Escape')
    editor.gone()
    editor.type('q')
    editor.opened()
    until(lambda: editor.asked()[0].text() == 'q', 'only what was typed now')
    editor.keys('ctrl+z', 'ctrl+z', 'ctrl+z')
    until(lambda: editor.asked()[0].text() == '', 'the line to be empty')
    editor.entry('Start')
    editor.entry('OUT Motor')
    assert '| NO Start | COIL Motor |' in editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def comments(screen):
    """a comment of two lines becomes one; a text that no file can hold is refused at the entry, which stays open"""
    path = file_with(screen, LIST.replace('Main IL', 'Main LD').replace(
        '  LD    Start\n  ST    Motor\n', '// what was\n// said before\nRUNG\n  | NO Start | COIL Motor |\n'))
    before = open(path).read()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+semicolon')
    until(lambda: editor.asked() and editor.asked()[0].text() == 'what was said before', 'what stands above the rung')
    editor.keys('Return')
    editor.gone()
    editor.keys('semicolon')
    editor.opened()
    editor.put_clipboard('one\r\n  two\n')
    editor.keys('ctrl+v')
    until(lambda: editor.asked() and editor.asked()[0].text() == 'one two', 'what is pasted, as one line')
    editor.keys('Return')
    editor.gone()
    assert editor.save(path) == before.replace('NO Start', 'NO Start (* one two *)')
    for key, text, why in (('semicolon', 'a *) b', 'a comment is one line without (* and *)'), ('ctrl+l', 'a b', 'this is not a name')):
        editor.keys(key)
        editor.opened()
        editor.keys('ctrl+a')
        editor.type(text)
        editor.says(why)
        editor.keys('Return')
        assert editor.asked()[0].text() == text
        editor.shot('words-' + key)
        editor.keys('Escape')
        editor.gone()
    editor.keys('ctrl+z')
    assert editor.save(path) == before
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def as_it_is(screen):
    """Return twice, or a double click and Return, on undeclared names declares them"""
    path = file_with(screen, UNKNOWN)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Return')
    editor.opened()
    editor.keys('Return')
    editor.gone()
    editor.element('Motor', '%IX0.0')
    editor.click(editor.middle(editor.element('Lamp')), count=2)
    editor.opened()
    editor.keys('Return')
    editor.gone()
    editor.to_sheet()
    editor.keys('Home', 'Right', 'Return')
    editor.opened()
    editor.keys('Return')
    editor.gone()
    text = editor.save(path)
    check(path)
    assert '| NO Motor | TON D1 PT:=T#5s | COIL Lamp |' in text, text
    assert lines(path, '@print Lamp\nMotor=1\n+5000\n') == ['Lamp=0', 'Lamp=1']
    editor.keys(*['ctrl+z'] * 3)
    assert editor.save(path) == UNKNOWN


def to_rung(screen):
    """Ctrl+G goes to a rung; a number without a rung is refused"""
    path = file_with(screen, LIST.replace('Main IL', 'Main LD').replace(
        '  LD    Start\n  ST    Motor\n', 'RUNG\n  | NO Start | COIL Motor |\nRUNG\n  | NC Start | COIL Lamp |\n'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.brought('ctrl+g')
    editor.says('1 to 2')
    for text in '3', 'x', '-1', '2x':
        editor.keys('ctrl+a')
        editor.type(text)
        editor.keys('Return')
        assert not editor.find('Go', 'push button').has(24), text  # sensitive
    editor.shot('words-rung')
    editor.keys('ctrl+a')
    editor.type('2')
    until(lambda: editor.find('Go', 'push button').has(24), 'the way to be open')
    editor.keys('Return')
    until(lambda: editor.all('Rung 2 ', 'label'), 'the second rung')
    editor.to_sheet()


main([next_problem, next_place, a_list, wrong_lines, in_parallel, pointed_at, other_keys, window_keys, again, comments, as_it_is, to_rung])
