#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""text - programs typed as text, and files that cannot be read."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

IL = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main IL
  LD Start
END_PROGRAM
'''
NAMES = IL.replace('LD Start', 'LD    Start\n  ST    Motor') + '''
PROGRAM Second IL
  LD    Motor
  ST    %QX0.1
END_PROGRAM
'''
DAMAGED = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor
END_PROGRAM
'''
TWO = IL.replace('LD Start', 'LD    Start\n  ST    Motor') + '''
PROGRAM Second IL
  LD    Start
  ST    %QX0.1
END_PROGRAM
'''
EXTRA = '\nPROGRAM Extra IL\n  LD Start\nEND_PROGRAM\n'


def in_the_text(screen, text):
    """An editor with the focus in the text of that program, its path, and that text."""
    path = new_file(screen, text)
    editor = Editor(screen, path)
    view = editor.find('Text of the program')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    return editor, path, view


def typed(screen):
    """an instruction list is typed, with a mistake that is mended"""
    editor, path, _ = in_the_text(screen, IL)
    editor.keys('ctrl+Home', 'Down', 'End', 'Return')
    editor.type('STT Motor')
    editor.says('error')
    editor.shot('text-mistake')
    editor.keys('ctrl+Left', 'BackSpace', 'BackSpace')
    editor.type(' ')
    editor.says('no problems')
    text = editor.save(path)
    assert 'ST Motor' in ' '.join(text.split()), text
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


def damaged(screen):
    """a damaged file opens as text with its problems, is mended there, and drawn"""
    editor, path, _ = in_the_text(screen, DAMAGED)
    editor.says('error')
    editor.shot('text-damaged')
    editor.keys('ctrl+End', 'Up', 'Up', 'End')
    editor.type(' |')
    until(lambda: len(editor.cells()) == 2, 'the sheet with its two elements')
    editor.says('no problems')
    editor.shot('text-mended')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


def back_and_forth(editor, path, view, said):
    """The text with an error is reported, saved as it is shown and not simulated; undo restores it."""
    editor.says(said)
    seen = view.text().strip()
    text = editor.save(path)
    assert seen in text and text.count('PROGRAM Second IL') == 1 and text.count('Extra') == seen.count('Extra'), text
    editor.keys('ctrl+m')
    editor.says(said)
    assert not editor.all('SIMULATION')
    editor.keys(*['ctrl+z'] * 8)
    editor.says('no problems')
    assert editor.save(path) == TWO
    editor.keys(*['ctrl+y'] * 8)
    editor.says(said)
    assert editor.save(path) == text
    check(path)


def emptied(screen):
    """a list is emptied and written again: other programs are untouched, undo restores it"""
    editor, path, view = in_the_text(screen, TWO)
    editor.keys('ctrl+a', 'Delete')
    back_and_forth(editor, path, view, 'expected: PROGRAM')
    editor.keys(*['ctrl+z'] * 8)
    editor.keys('ctrl+Prior', 'ctrl+Prior')  # the advice that Motor is never read was there
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the text')
    editor.keys('ctrl+a')
    editor.type('x y')
    editor.says('error')
    assert 'x y' in editor.save(path) and 'PROGRAM Second IL' in open(path).read()


def one_more(screen):
    """a program typed behind the list's own is kept once and reported as misplaced"""
    editor, path, view = in_the_text(screen, TWO)
    editor.keys('ctrl+End')
    editor.put_clipboard(EXTRA)
    editor.keys('ctrl+v')
    back_and_forth(editor, path, view, '"Extra" does not belong here')


def closed(screen):
    """the window is closed right behind the last letter: it asks, and the saved file has that letter"""
    editor, path, _ = in_the_text(screen, IL)
    editor.keys('ctrl+Home', 'Down', 'End', 'Return')
    editor.type('ST Motor')
    editor.keys('ctrl+w')
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the window to close')
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']


def names(screen):
    """in a list, too: F12 goes to where the name is driven, F2 renames it, Shift+F12 lists its uses"""
    editor, path, view = in_the_text(screen, NAMES)
    editor.keys('ctrl+Page_Down')
    second = until(lambda: [node for node in editor.all('Text of the program') if 'QX0.1' in node.text()], 'the second list')[0]
    editor.click(second)
    until(lambda: second.has(12), 'the focus in the second list')
    editor.keys('ctrl+Home', 'Down', 'End')
    editor.says('Line 2 · column 14')
    editor.says('F12: Go to coil')
    editor.shot('text-place')
    editor.keys('F12')
    until(lambda: [node for node in editor.all('Text of the program') if 'ST    Motor' in node.text() and node.has(12)],
          'the list that drives it')
    editor.keys('shift+F12')
    editor.find('Second, line', 'label')
    editor.click(view)
    editor.keys('ctrl+Home', 'Down', 'Down', 'End')
    editor.brought('F2')
    editor.says('Rename')
    editor.shot('text-rename')
    editor.keys('ctrl+a')
    editor.type('Pump')
    editor.keys('Return')
    until(lambda: 'ST    Pump' in view.text() or [n for n in editor.all('Text of the program') if 'Pump' in n.text()], 'the new name')
    text = editor.save(path)
    assert text == NAMES.replace('Motor AT', 'Pump  AT').replace('Motor', 'Pump'), text
    check(path)
    # To a line; not beyond the last one.
    editor.brought('ctrl+g')
    editor.says('Go to line')
    editor.type('99')
    until(lambda: not editor.find('Go', 'push button').has(8), 'no way to go there')  # enabled
    editor.keys('ctrl+a')
    editor.type('1')
    editor.keys('Return')
    editor.says('Line 1 \u00b7 column 1')
    # On an address, and on no name.
    editor.keys('ctrl+Page_Down')
    second = until(lambda: [node for node in editor.all('Text of the program') if 'QX0.1' in node.text()], 'the second list')[0]
    editor.click(second)
    editor.keys('ctrl+Home', 'Down', 'Down', 'End', 'F2')
    editor.says('Only declared names can be renamed')


def at_once(screen):
    """a project whose first program is a list opens with the keys in the text; F6 and menu entries move them there from the header"""
    path = new_file(screen, TWO.replace('PROGRAM Second IL\n  LD    Start\n  ST    %QX0.1', 'PROGRAM Second LD\nRUNG\n  | NO Start | COIL %QX0.1 |'))
    editor = Editor(screen, path)
    editor.focus_on('Text of the program', 'text')
    editor.shot('text-at-once')
    editor.keys('ctrl+Home', 'Down', 'End', 'Return')
    editor.type('ANDN Motor')
    assert 'ANDN  Motor' in editor.save(path)

    def header():
        editor.click(editor.find('Save', 'push button'))  # a click gives a button the keys
        editor.focus_on('Save', 'push button')
    header()
    editor.keys('F6')
    editor.focus_on('Text of the program', 'text')
    header()
    editor.keys('ctrl+Page_Down')
    editor.to_sheet()
    header()
    editor.keys('F6')
    editor.to_sheet()
    assert editor.all('Second, 1 rung') and len(editor.cells()) == 2, editor.cells()
    header()
    editor.keys('ctrl+alt+s')
    editor.focus_on('Scope')
    header()
    editor.keys('F6')
    editor.focus_on('Scope')


def no_bookmark(screen):
    """Ctrl+B in a text says why there is no bookmark, and leaves the text"""
    editor, path, view = in_the_text(screen, TWO)
    before = view.text()
    editor.keys('ctrl+b')
    until(lambda: editor.all('This works on rungs and networks. Open a sheet first.', 'label'),
          'why not')
    editor.shot('text-no-bookmark')
    assert view.text() == before and 'VIEW' not in open(path).read()


typed.quick = 'editor-gtk/text'
main([no_bookmark, names, typed, damaged, emptied, one_more, closed, at_once])
