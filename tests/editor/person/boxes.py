#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""boxes - changes of a box: another instance, a value at a pin by pointer, another input."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
  Wait  : TIME := T#5s;
  D1    : TON;
  D2    : TON;
  Parts : CTU;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | TON D1 PT:=Wait | COIL Lamp |
RUNG
  | NO Start | CTU Parts PV:=7 | COIL %QX0.1 |
END_PROGRAM
'''


def instance(screen):
    """another instance keeps the parameters that the typed line does not mention"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'Right', 'Return', 'ctrl+a')
    editor.opened()
    editor.entry('D2')
    assert '| TON D2 PT:=Wait |' in editor.save(path)
    editor.keys('Home', 'Right', 'Return', 'ctrl+a')
    editor.opened()
    editor.entry('D1 T#3s')
    text = editor.save(path)
    assert '| TON D1 PT:=T#3s |' in text, text
    check(path)


def twice(editor, at):
    editor.click(at, count=2)
    return until(editor.asked, 'an entry')[0]


def values(screen):
    """a double click on the value at a pin selects it in the entry; on a pin without a value the entry begins one"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    x, y, width, height = editor.place(editor.element('TON'))
    # PT stands one line of pins below the wire.
    line = twice(editor, (x + 20, y + 46 + 16))
    editor.shot('boxes-value')
    editor.type('T#9s')
    until(lambda: line.text() == 'D1 PT:=T#9s', 'D1 PT:=T#9s')
    editor.keys('Return')
    editor.gone()
    x, y, width, height = editor.place(editor.element('CTU'))
    line = twice(editor, (x + width - 20, y + 46 + 16))
    until(lambda: line.text() == 'Parts PV:=7 CV=>', 'Parts PV:=7 CV=>')
    editor.type('Count')
    editor.says('new: Count : INT')
    editor.shot('boxes-output')
    editor.keys('Return')
    editor.gone()
    # A double click on the name above the box selects the whole line.
    x, y, width, height = editor.place(editor.element('TON'))
    line = twice(editor, (x + width // 2, y + 8))
    editor.type('D2')
    until(lambda: line.text() == 'D2', 'D2')
    editor.keys('Return')
    editor.gone()
    text = editor.save(path)
    assert '| TON D2 PT:=T#9s |' in text and '| CTU Parts PV:=7 CV=>Count |' in text and '  Count : INT;\n' in text, text
    check(path)


def twice_there(screen):
    """a duplicated rung gets a timer of its own, in one step of the history"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+d')
    editor.says('D3 : TON')
    editor.element('Rung 2', 'D3')
    editor.shot('boxes-twice')
    text = editor.save(path)
    assert text.count('TON D1 PT:=Wait') == 1 and '| NO Start | TON D3 PT:=Wait | COIL Lamp |' in text, text
    assert re.search('  D3 +: TON;\n', text), text
    editor.keys('ctrl+z')
    assert editor.save(path) == PROJECT
    # The copy of a RETAIN counter is RETAIN too.
    kept = PROJECT.replace('  Parts : CTU;\nEND_VAR', 'END_VAR\n\nVAR RETAIN\n  Parts : CTU;\nEND_VAR')
    path = new_file(screen, kept, 'kept.rung')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Down', 'ctrl+d')
    editor.says('Parts1 : CTU RETAIN')
    text = editor.save(path)
    assert 'VAR RETAIN\n  Parts1 : CTU;\nEND_VAR\nRUNG' in text and '| CTU Parts1 PV:=7 |' in text, text
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == kept


COUNTER = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Back  AT %IX0.1 : BOOL;
  Zero  AT %IX0.2 : BOOL;
  Parts : CTUD;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | CTUD Parts PV:=7 | COIL %QX0.1 |
END_PROGRAM
'''


def feed(editor, pin, contact):
    editor.keys('ctrl+i')
    editor.opened()
    editor.entry(pin)
    editor.entry(contact)


def inputs(screen):
    """two inputs of one box are fed one after the other, the second from the place of the cursor after the first"""
    path = new_file(screen, COUNTER)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'Right')
    feed(editor, 'CD', 'Back')
    editor.says('Rung 1 · row 2 · column B')
    editor.keys('ctrl+i')
    editor.opened()
    editor.candidate('R, input')
    assert not editor.all('CD, input', 'list item'), 'CD is fed'
    editor.keys('Escape')
    editor.gone()
    feed(editor, 'R', 'Zero')
    editor.shot('boxes-inputs')
    text = editor.save(path)
    assert '  | NO Back  | .CD' in text and '  | NO Zero  | .R ' in text, text
    check(path)


def refused(editor, why):
    """The entry says why; what is typed and Enter change nothing, Esc closes it."""
    editor.says(why)
    editor.type('Back')
    editor.keys('Return')
    editor.says(why)
    assert editor.asked(), 'the entry is closed'
    editor.keys('Escape')
    editor.gone()


def one_line(screen):
    """one line feeds an input: pin and operand, by key or by a double click on the pin; a refusal changes nothing"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    before = open(path).read()
    editor.keys('Down', 'Home', 'Right', 'ctrl+i')
    editor.opened()
    editor.type('Z Start')
    editor.says('is not a Boolean input of CTU; write the input first, such as R ')
    editor.keys('Return')
    editor.says('is not a Boolean input of CTU; write the input first, such as R ')
    editor.shot('boxes-refused')
    editor.keys('Escape')
    editor.gone()
    editor.keys('ctrl+i')
    editor.opened()
    editor.entry('PV 9')
    assert editor.save(path) == before.replace('PV:=7', 'PV:=9')
    x, y, width, height = editor.place(editor.element('CTU'))
    line = twice(editor, (x + 20, y + 46 + 16))
    until(lambda: line.text() == 'R ', 'R ')
    editor.entry('!ResetCount')
    text = editor.save(path)
    assert re.search(r'CTU Parts PV:=9 +\| COIL %QX0.1 \|\n +\| NC ResetCount +\| \.R', text), text
    assert 'ResetCount AT %IX0.1 : BOOL;' in text, text
    editor.shot('boxes-one-line')
    check(path)
    editor.keys('ctrl+z', 'ctrl+z')
    assert editor.save(path) == before, 'one step each'


def nothing_left(screen):
    """Ctrl+I says at the entry that no input is left; on a row of pins it acts on the box"""
    path = new_file(screen, COUNTER.replace('| COIL %QX0.1 |', '| TON Long PT:=T#5s | COIL %QX0.1 |')
                    .replace('END_VAR', '  Long : TON;\nEND_VAR'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'ctrl+i')
    refused(editor, 'there is no box here')
    editor.keys('Right', 'Right', 'ctrl+i')
    refused(editor, 'The box has no further Boolean input')
    editor.keys('Left')
    feed(editor, 'CD', 'Back')
    editor.keys('ctrl+i')
    editor.candidate('R, input')
    editor.keys('Escape')
    editor.gone()
    feed(editor, 'R', 'Zero')
    feed(editor, 'LD', 'Back')
    editor.keys('ctrl+i')
    refused(editor, 'The box has no further Boolean input')
    text = editor.save(path)
    assert all(re.search(r'NO %s +\| \.%s ' % pair, text) for pair in (('Back', 'CD'), ('Zero', 'R'), ('Back', 'LD'))), text
    check(path)


def below(screen):
    """Return in a row of pins edits the box, where the cursor is"""
    path = new_file(screen, COUNTER.replace(' |\nEND_PROGRAM', ' |\n  | NO Back | .CD |\nEND_PROGRAM'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Home', 'Down', 'Right')
    editor.says('Rung 1 · row 2 · column B')
    editor.keys('Return', 'ctrl+a')
    editor.opened()
    editor.entry('Parts PV:=9 R:=Zero')
    text = editor.save(path)
    assert '| CTUD Parts PV:=9 R:=Zero |' in text and re.search(r'NO Back +\| \.CD', text), text
    check(path)


main([instance, values, twice_there, inputs, one_line, nothing_left, below])
