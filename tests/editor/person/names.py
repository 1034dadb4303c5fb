#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""names - find, replace, rename everywhere, and go to the coil that drives a name."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
RUNG
  | NO Motor | COIL Lamp |
END_PROGRAM
'''


JUMPS = '''RUNGBOARD 1

VAR
  N    AT %IW0   : INT;
  M    AT %IW2   : INT;
  Lamp AT %QX0.0 : BOOL;
  Stop AT %IX0.7 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO %IX0.0 | JMP Here |
RUNG
  | NO %IX0.1 | CALL Sub |
RUNG
  | NO Stop | JMP Here |
RUNG
  | NO Stop | COIL %QX0.1 |
RUNG Here
  | [ N > M ] | COIL Lamp |
END_PROGRAM

SUBROUTINE Sub LD
RUNG
  | NO %IX0.2 | COIL %QX0.3 |
END_SUBROUTINE
'''
JUMPED = '@print %QX0.1\n%IX0.7=1\n%IX0.0=1\n%IX0.7=0\n'
NOT_JUMPED = ['%QX0.1=0', '%QX0.1=0', '%QX0.1=0']
COMPARED = '@print %QX0.0\n%IW0=2\n%IW2=5\n'


def question(editor, *keys):
    """F2 and the line of its entry."""
    editor.keys(*keys, 'F2')
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    return line


def name_it(editor, text):
    """Replaces the text of the entry by another name."""
    editor.keys('ctrl+a')
    editor.type(text)


def stays(editor, line, text, reason):
    """Return with a refused name: the entry stays with its text and the reason."""
    name_it(editor, text)
    until(lambda: [node for node in editor.all(reason, 'label') if node.name == reason], 'the reason ' + reason)
    editor.keys('Return')
    editor.says('Rename everywhere')
    assert line.text() == text and line.has(12) and editor.all(reason, 'label')


def refused(screen):
    """a refused name: the reason is shown while typing, the entry stays open; Esc closes it"""
    path = new_file(screen, JUMPS)
    editor = Editor(screen, path)
    editor.to_sheet()
    line = question(editor, 'Down', 'Down', 'Home')
    stays(editor, line, '2x', '\u201c2x\u201d is not a name')
    stays(editor, line, 'a b', '\u201ca b\u201d is not a name')
    stays(editor, line, 'VAR', '\u201cVAR\u201d is a word of the language')
    stays(editor, line, 'lamp', '\u201clamp\u201d is declared already (the globals)')
    editor.shot('names-refused')
    editor.keys('ctrl+a', 'BackSpace')
    editor.says('Enter a name')
    editor.keys('Escape')
    editor.to_sheet()
    line = question(editor)
    stays(editor, line, 'sub', '\u201csub\u201d is declared already (Sub)')
    name_it(editor, 'Halt')
    until(lambda: not editor.all('declared already', 'label'), 'no reason any more')
    editor.keys('Return')
    editor.says('3 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert 'Stop' not in text and text.count('Halt') == 3, text
    check(path)
    assert lines(path, JUMPED) == NOT_JUMPED
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS


def jumps(screen):
    """F12 on a jump goes to its label, F2 renames both, Ctrl+L changes the jumps, too"""
    path = new_file(screen, JUMPS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('End', 'F12')
    editor.says('Rung 5')
    editor.to_sheet()
    editor.keys('shift+F12')
    editor.find('N %IW0 read', 'table row')
    editor.keys('Right', 'shift+F12')
    editor.find('jumped to, Main, rung 3', 'table row')
    editor.to_sheet()
    editor.keys('Up', 'Up', 'End')
    editor.says('Rung 3')
    question(editor)
    name_it(editor, 'There')
    editor.keys('Return')
    editor.says('3 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert text == JUMPS.replace('Here', 'There'), text
    check(path)
    assert lines(path, JUMPED) == NOT_JUMPED
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS
    editor.keys('F12')
    editor.says('Rung 5')
    editor.keys('ctrl+l')
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('Done')
    editor.says('2 jumps follow')
    text = editor.save(path)
    assert text == JUMPS.replace('Here', 'Done'), text
    check(path)
    assert lines(path, JUMPED) == NOT_JUMPED
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS


def labels(screen):
    """a label that another rung has is refused if jumps would follow; without jumps it is just a text"""
    path = new_file(screen, JUMPS.replace('RUNG\n  | NO Stop | COIL', 'RUNG Other\n  | NO Stop | COIL'))
    text = open(path).read()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('End', 'F12')
    editor.says('Rung 5')
    editor.keys('ctrl+l')
    editor.opened()
    editor.keys('ctrl+a')
    editor.type('other')
    editor.says('\u201cother\u201d is declared already (Main, rung 4)')
    editor.keys('Return')
    assert editor.asked()
    editor.keys('ctrl+a')
    editor.type('VAR')
    editor.says('this is not a name')
    editor.keys('Escape')
    editor.gone()
    editor.keys('Up', 'ctrl+l')
    editor.opened()
    editor.keys('ctrl+a')
    editor.entry('Others')
    assert editor.save(path) == text.replace('Other', 'Others')
    check(path)
    assert lines(path, JUMPED) == NOT_JUMPED
    editor.keys('ctrl+z')
    assert editor.save(path) == text


def on_sheet(editor):
    """Waits until the visible sheet has the focus."""
    until(lambda: [node for node in editor.all('Sheet') if node.has(12)], 'the focus on its sheet')


def calls(screen):
    """F12 on a call goes to the called block, F2 renames it"""
    path = new_file(screen, JUMPS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('Down', 'Home', 'Right', 'F12')
    editor.element('%IX0.2')
    on_sheet(editor)
    editor.keys('ctrl+Page_Up')
    editor.element('%IX0.1')
    on_sheet(editor)
    question(editor)
    name_it(editor, 'Part')
    editor.keys('Return')
    editor.says('2 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert text == JUMPS.replace('CALL Sub', 'CALL Part').replace('SUBROUTINE Sub', 'SUBROUTINE Part'), text
    check(path)
    assert lines(path, '@print %QX0.3\n%IX0.1=1 %IX0.2=1\n') == ['%QX0.3=1']
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS


def operands(screen):
    """an element with several names asks which one"""
    path = new_file(screen, JUMPS)
    editor = Editor(screen, path)
    editor.to_sheet()
    line = question(editor, 'End', 'F12', 'Home')
    until(lambda: line.text() == 'N', 'the N')
    editor.shot('names-choice')
    editor.keys('shift+Tab')
    editor.focus_on('Which name')
    editor.keys('space')
    editor.choose('M')
    until(lambda: line.text() == 'M', 'the name that was chosen')
    editor.says('“M” is used in 2 places.')
    editor.keys('Tab')
    until(lambda: line.has(12), 'the focus in the line')
    name_it(editor, 'Most')
    editor.keys('Return')
    editor.says('2 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert '[ N > Most ]' in text and 'N    AT' in text, text
    check(path)
    assert lines(path, COMPARED) == ['%QX0.0=1', '%QX0.0=0']
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS


def rename(screen):
    """rename a symbol everywhere, undo it, redo it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('End', 'F2')
    line = until(editor.asked, 'the new name')[0]
    until(lambda: line.has(12), 'the focus in the line')
    editor.keys('ctrl+a')
    editor.type('Pump')
    editor.shot('names-rename')
    editor.keys('Return')
    editor.says('3 places changed')
    editor.to_sheet()
    text = editor.save(path)
    assert 'Motor' not in text and text.count('Pump') == 3, text
    check(path)
    assert lines(path, '@print Lamp\nStart=0\nStart=1\n') == ['Lamp=0', 'Lamp=1']
    editor.keys('ctrl+z')
    before = editor.save(path)
    assert 'Pump' not in before and before.count('Motor') == 3, before
    editor.keys('ctrl+shift+z')
    assert editor.save(path) == text
    assert lines(path, '@print Pump\nStart=0\nStart=1\n') == ['Pump=0', 'Pump=1']


def drawn(editor, name):
    """The buttons of that name that have been drawn. GTK ignores the press of one that has no place yet: nobody sees it."""
    return [button for button in editor.all(name, 'push button') if button.box()[3] > 0]


def reloaded(screen):
    """the project is read again while the dialog asks for the name: the same symbol gets it, whatever its number"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    line = question(editor, 'End')
    assert line.text() == 'Motor'
    with open(path, 'w') as file:
        file.write(PROJECT.replace('VAR\n', 'VAR\n  First : INT;\n', 1))
    until(lambda: drawn(editor, 'Reload'), 'the banner')[0].press()
    until(lambda: not editor.all('Reload', 'push button'), 'the end of the banner')
    editor.says('“Motor” is used')
    until(lambda: [node for node in editor.all('4', 'label') if node.name == '4'], 'the new symbol in the tree')
    name_it(editor, 'Pump')
    editor.keys('Return')
    editor.says('3 places changed')
    text = editor.save(path)
    assert 'Motor' not in text and text.count('Pump') == 3 and 'First : INT' in text, text
    check(path)


def find(screen):
    """find a name, go to the coil that drives it"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.keys('ctrl+f')
    editor.type('Lamp')
    editor.keys('Return')
    until(lambda: any('Rung 2' in node.name for node in editor.all('Rung 2')), 'the place of the find')
    editor.shot('names-find')
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('Home', 'F12')
    editor.says('Rung 1')


def is_open(editor):
    return [node for node in editor.all('Find', 'text') if node.name == 'Find']


def hits(screen):
    """Return goes from hit to hit and keeps the keys in the bar; Esc moves them to the sheet there, and closes the
    bar next"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    editor.to_sheet()
    before = editor.cells()
    editor.keys('ctrl+f')
    editor.type('Motor')
    editor.says('3 hits')
    for keys, place in ('Return', '2 of 3'), ('Return', '3 of 3'), ('Return', '1 of 3'), ('shift+Return', '3 of 3'), (
            'shift+Return', '2 of 3'), ('F3', '3 of 3'), ('shift+F3', '2 of 3'):
        editor.keys(keys)
        editor.says(place)
        editor.focus_on('Find', 'text')
    editor.keys('Escape')
    editor.to_sheet()
    editor.says('Rung 1')
    until(lambda: not is_open(editor), 'the bar to be closed')
    editor.keys('F3')
    editor.to_sheet()
    # On the sheet, Esc restores the rung first.
    editor.keys('ctrl+f')
    editor.focus_on('Find', 'text')
    editor.click(editor.middle(editor.element('Rung 2, NO', 'Motor')))
    editor.to_sheet()
    editor.keys('slash')
    editor.element('Rung 2, NC', 'Motor')
    editor.keys('Escape')
    editor.element('Rung 2, NO', 'Motor')
    assert is_open(editor)
    # A selection is cleared first, too.
    editor.keys('shift+Right', 'Escape')
    editor.to_sheet()
    assert is_open(editor)
    editor.keys('Escape')
    until(lambda: not is_open(editor), 'the bar to be closed')
    editor.to_sheet()
    # In the symbols only the search text is written.
    editor.keys('ctrl+f')
    editor.type('Start')
    editor.says('2 hits')
    editor.keys('Return')
    editor.says('of 2')
    if editor.all('2 of 2'):
        editor.keys('Return')
    editor.says('1 of 2')
    editor.focus_on('Find', 'text')
    editor.keys('Escape')
    until(lambda: not is_open(editor), 'the bar to be closed')
    editor.focus_on('Start, Name', 'text')
    editor.shot('names-found-symbol')
    editor.keys('ctrl+Page_Up')
    editor.to_sheet()
    assert editor.cells() == before, editor.cells()


def address(screen):
    """a search for an address also finds the symbols at it; replace changes texts only"""
    path = new_file(screen, JUMPS)
    editor = Editor(screen, path)
    editor.keys('ctrl+h')
    editor.type('%QX0.0')
    editor.says('2 hits')
    editor.keys('Return')
    editor.says('of 2')
    editor.into('Replace with')
    editor.type('%QX0.7')
    editor.find('Replace all', 'push button').press()
    editor.says('1 replaced')
    text = editor.save(path)
    assert text == JUMPS.replace('%QX0.0', '%QX0.7'), text
    check(path)
    assert lines(path, COMPARED.replace('%QX0.0', '%QX0.7')) == ['%QX0.7=1', '%QX0.7=0']
    editor.keys('Escape')
    editor.to_sheet()
    editor.keys('ctrl+z')
    assert editor.save(path) == JUMPS


def beside(screen):
    """rename everywhere lists scenario and plant before, changes and saves them with the project; one undo takes all back"""
    path = new_file(screen, PROJECT)
    scenario, plant = path.replace('.rung', '.scn'), path.replace('.rung', '.plant.rung')
    tests = 'scenario "Motor runs"\n  at 0ms Start = 1\n  at 20ms expect Motor = 1\n'
    world = ('RUNGBOARD 1\n\nVAR\n  Motor AT %IX0.0 : BOOL;\nEND_VAR\n\nPROGRAM World LD\nRUNG\n'
             '  | NO Motor | COIL %QX0.5 |\nEND_PROGRAM\n')
    for file, text in (scenario, tests), (plant, world):
        with open(file, 'w') as out:
            out.write(text)
    editor = Editor(screen, path)
    editor.to_sheet()
    question(editor, 'ctrl+Home', 'End')
    editor.says(os.path.basename(scenario) + ': 1 place')
    editor.says(os.path.basename(plant) + ': 2 places')
    editor.shot('names-beside')
    name_it(editor, 'Pump')
    editor.keys('Return')
    editor.says('6 places changed')
    until(lambda: editor.all('\u2022 ' + os.path.basename(scenario)), 'the tab of the scenario')
    editor.to_sheet()
    editor.shot('names-beside-done')
    text = editor.save(path)
    assert text.count('Pump') == 3 and 'Motor' not in text, text
    until(lambda: open(scenario).read() == tests.replace('Motor = 1', 'Pump = 1') and
          open(plant).read().count('Pump') == 2, 'scenario and plant to be saved with the project')
    until(lambda: not editor.all('\u2022 '), 'no tab with changes')
    editor.keys('ctrl+z')
    editor.to_sheet()
    text = editor.save(path)
    assert text.count('Motor') == 3 and 'Pump' not in text, text
    until(lambda: open(scenario).read() == tests and open(plant).read() == world, 'the old names in all files')
    # In the tab of a scenario, Ctrl+S saves that file alone.
    editor.keys('ctrl+y')
    editor.to_sheet()
    editor.keys('ctrl+Page_Down', 'ctrl+Page_Down', 'ctrl+Page_Down')
    until(lambda: 'expect Pump' in editor.find(os.path.basename(scenario), 'text').text(), 'the scenario')
    assert editor.save(scenario) == tests.replace('Motor = 1', 'Pump = 1')
    assert 'Pump' not in open(path).read()


if __name__ == "__main__": main([rename, reloaded, beside, find, hits, address, refused, jumps, labels, calls, operands])
