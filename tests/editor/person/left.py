#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""left - a click elsewhere while the entry is open: its text is taken, or the reason why not is shown."""
import os
import signal
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, sh, until  # noqa: E402
from screen import close_window  # noqa: E402


def away(editor):
    """A point far below all rungs."""
    editor.click(editor.grid(400, 3))
    editor.gone()


def elements(screen):
    """an element, its operand, a title and a comment are taken; Esc still drops them"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('Open')
    editor.opened()
    away(editor)
    editor.element('Open')
    editor.keys('Home', 'Return', 'ctrl+a')
    editor.type('Shut')
    away(editor)
    editor.element('Shut')
    editor.keys('Home', 'semicolon')
    editor.opened()
    editor.type('the gate')
    away(editor)
    editor.keys('ctrl+shift+t')
    editor.opened()
    editor.type('Gate')
    away(editor)
    editor.keys('End')
    editor.entry('OUT Lamp')
    text = editor.save(path)
    assert 'RUNG "Gate"' in text and '| NO Shut (* the gate *) | COIL Lamp |' in text, text
    check(path)
    editor.keys('Home', 'Right')
    editor.type('Never')
    editor.opened()
    editor.keys('Escape')
    editor.gone()
    assert not editor.all('Never')
    # An unchanged operand is no edit.
    editor.keys('Home', 'Return')
    editor.opened()
    away(editor)
    assert not [node for node in editor.all('\u2022 new.rung', 'label')]


def wrong(screen):
    """a wrong text is reported, with the text"""
    path = new_file(screen)
    editor = Editor(screen, path)
    before = open(path).read()
    editor.to_sheet()
    editor.type('FROB it')
    editor.says('“FROB” is not the word of an element or block')
    away(editor)
    editor.says('"FROB it" was not applied')
    editor.shot('left-wrong')
    editor.type('OUT')
    editor.opened()
    away(editor)
    editor.says('"OUT" was not applied')
    editor.entry('OUT Lamp')
    editor.keys('ctrl+z', 'ctrl+z')
    until(lambda: not editor.elements(), 'an empty rung')
    assert open(path).read() == before


def dropped(screen):
    """a proposed instance of a box is taken, too; a contact without an operand is dropped"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find an element')
    editor.type('TON')
    until(lambda: not editor.all('NC: ', 'push button', editor.palette), 'the timers alone')
    editor.drag(editor.tile('TON: '), editor.grid(50, 0))
    editor.opened()
    away(editor)
    editor.element('TON', 'Delay1')
    editor.click(editor.find('Find an element'))
    editor.keys('Escape')
    editor.drag(editor.tile('NC: '), editor.grid(50, 3))
    editor.opened()
    away(editor)
    until(lambda: len(editor.elements()) == 1, 'the timer alone')
    editor.keys('End')
    editor.entry('OUT Lamp')
    assert '| TON Delay1 PT:=T#1s | COIL Lamp |' in editor.save(path)


CHART = 'RUNGBOARD 1\n\nPROGRAM Main SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n'


def charts(screen):
    """the same on a chart"""
    path = new_file(screen, CHART)
    editor = Editor(screen, path)
    step = editor.find('Step Start, initial', 'table cell')
    until(lambda: editor.find('Chart').has(12), 'the focus on the chart')
    editor.keys('F9')
    editor.opened()
    editor.type('N Horn AT %QX0.5')
    x, y, width, height = editor.place(step)
    editor.click((x + width + 300, y + height + 200))
    editor.gone()
    editor.find('Start does: N Horn', 'table cell')
    assert 'Horn AT %QX0.5' in editor.save(path)


def closed(screen):
    """the window is closed by a task bar: the question is about a program with the typed text; a wrong text keeps the window once"""
    path = new_file(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('FROB it')
    editor.opened()
    close_window(int(editor.window))
    editor.says('"FROB it" was not applied')
    assert editor.windows() and not editor.all(role='dialog')
    editor.keys('Home')
    editor.entry('Open')
    editor.keys('ctrl+s')
    editor.says('Saved')
    editor.type('OUT Lamp')
    editor.opened()
    close_window(int(editor.window))
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the end')
    assert '| NO Open | COIL Lamp |' in open(path).read()
    check(path)


def ended(screen):
    """SIGTERM while the entry is open: its text is in the draft"""
    path = new_file(screen)
    before = open(path).read()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.type('Open')
    until(lambda: [node.text() for node in editor.asked()] == ['Open'], 'the whole text in the entry')
    os.kill(editor.pid, signal.SIGTERM)
    until(lambda: editor.process.poll() is not None, 'the end')
    assert open(path).read() == before
    editor = Editor(screen, path)
    editor.element('Open')


TABLE = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Horn  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main ST
  Horn := Start;
END_PROGRAM
'''


def saved_soon(editor, path, wanted):
    until(lambda: wanted in open(path).read(), '"%s" in the file' % wanted)


def at_once(screen):
    """what is typed in a cell or a text is in the file, though a click elsewhere and Ctrl+S follow at once"""
    path = new_file(screen, TABLE)
    editor = Editor(screen, path)
    view = editor.find('Text of the program')
    elsewhere = editor.centre(until(lambda: [node for node in editor.all('Main', 'label') if node.box()[0] < 200],
                                    'the program in the tree')[0])
    for number in range(4):
        editor.click(view)
        until(lambda: view.has(12), 'the focus in the text')
        editor.keys('ctrl+Home', 'Down')
        sh('xdotool', 'type', '--delay', '5', '(* %d *)' % number)
        sh('xdotool', 'mousemove', *map(str, elsewhere), 'click', '1', 'key', 'ctrl+s')
        saved_soon(editor, path, '(* %d *)' % number)
    editor.keys('ctrl+alt+s')
    elsewhere = editor.centre(editor.find('Start, Comment', 'text'))
    for number in range(4):
        editor.into('Horn, Comment')
        editor.keys('ctrl+a')
        sh('xdotool', 'type', '--delay', '5', 'loud %d' % number)
        sh('xdotool', 'mousemove', *map(str, elsewhere), 'click', '1', 'key', 'ctrl+s')
        saved_soon(editor, path, 'loud %d' % number)
    check(path)


main([elements, wrong, dropped, charts, closed, ended, at_once])
