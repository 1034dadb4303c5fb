#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A ladder is shown as a list and as Structured Text, with values, and converted; a refusal leads to its cell."""
import os
import subprocess
import time
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import A11Y, Chinese, Editor, check, main, new_file, until  # noqa: E402
from live import POWER, pixels  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Horn  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "The motor seals itself in"
  | NO Start  | NC Stop | COIL Motor |
  | NO Motor ^|
RUNG
  | P Start | S Horn |
END_PROGRAM
'''
CHART = '''RUNGBOARD 1

VAR
  Go   AT %IX0.0 : BOOL;
  Lamp AT %QX0.0 : BOOL;
END_VAR

PROGRAM Way SFC
  INITIAL_STEP Start:
  END_STEP
  STEP Run:
    Lamp(N);
  END_STEP
  TRANSITION FROM Start TO Run := Go; END_TRANSITION
  TRANSITION FROM Run TO Start := NOT Go; END_TRANSITION
END_PROGRAM
'''
REFUSED = PROGRAM.replace('| P Start | S Horn |', '| NO Stop | STOP |')


def shows(editor, *parts):
    """Waits for a text with all these parts in the page in front."""
    def look():
        texts = [node.text() for node in editor.all(role='text')]
        return next((text for text in texts if all(part in text for part in parts)), None)
    return until(look, 'the text with %s' % ', '.join(parts))


def darkest(widget):
    """Red, green and blue of the middle of a widget's lower edge, where nothing is drawn."""
    x, y = widget.editor.centre(widget)
    body = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '1x1+%d+%d' % (x, y), 'rgb:-'], capture_output=True).stdout
    return tuple(body)


def described(text):
    """What a screen reader adds: the values of the line of the cursor."""
    return str(text.editor.bus.call_blocking(text.editor.name, text.path, 'org.freedesktop.DBus.Properties', 'Get', 'ss',
                                             (A11Y + 'Accessible', 'Description')))


def says(editor, text):
    return until(lambda: editor.all(text), text)


def shown(screen):
    """by the keyboard alone: as other languages, with values; the page follows edits, and is over with its POU"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+2')
    says(editor, '“Main” is in LD already')
    editor.keys('ctrl+4')
    says(editor, '“Main” as ST, read-only')
    shows(editor, 'PROGRAM Main ST', 'Motor := (Start OR Motor) AND NOT Stop;')
    assert not editor.all('Program or block'), 'a list of one program'
    editor.focus_on(role='text')
    editor.type('Q1Q')  # it is read-only
    assert 'Q1Q' not in shows(editor, 'PROGRAM Main ST')
    editor.keys('ctrl+3')
    says(editor, '“Main” as IL, read-only')
    shows(editor, 'PROGRAM Main IL', 'ANDN  Stop')
    editor.shot('show-il')
    editor.keys('ctrl+1')
    says(editor, '“Main” as FBD, read-only')
    until(lambda: editor.all('Network 1, The motor seals itself in'), 'the networks')
    editor.shot('show-fbd')
    editor.keys('ctrl+Page_Up', 'ctrl+Page_Up')
    editor.to_sheet()
    editor.keys('slash')
    until(lambda: editor.all('• new.rung'), 'the edit')
    time.sleep(1)  # the edit is checked while the page is out of sight: to come into sight must be enough
    editor.keys('ctrl+Page_Down', 'ctrl+Page_Down')
    until(lambda: [node for node in editor.all(role='table cell') if 'negated: Start' in node.name], 'the networks to follow')
    editor.keys('ctrl+Page_Up', 'ctrl+Page_Up')
    editor.to_sheet()
    editor.keys('ctrl+4')
    shows(editor, 'PROGRAM Main ST', 'Motor := (NOT Start OR Motor) AND NOT Stop;')
    editor.keys('ctrl+z')  # shows what it changes
    editor.to_sheet()
    editor.keys('ctrl+4')
    shows(editor, 'Motor := (Start OR Motor) AND NOT Stop;')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    text = editor.focus_on(role='text')
    editor.keys('ctrl+Home', *['Down'] * 5)
    until(lambda: 'value FALSE · FALSE · FALSE' in described(text), 'the values')
    editor.shot('show-st-live')
    editor.finish()


def converted(screen):
    """by the pointer: converted in one step, and undone; what cannot be converted leads to its cell"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.command('Convert to Structured Text')
    says(editor, '“Main” is in ST now')
    text = editor.save(path)
    assert 'PROGRAM Main ST\n' in text and 'Motor := (Start OR Motor) AND NOT Stop;' in text, text
    check(path)
    editor.keys('ctrl+z')
    says(editor, 'Undone: Convert to ST')
    assert editor.save(path) == PROGRAM
    editor.command('Show as instruction list')
    says(editor, '“Main” as IL, read-only')
    editor.find('Convert to instruction list', 'push button').press()
    says(editor, '“Main” is in IL now')
    until(lambda: not editor.all('Main as IL'), 'the page to be closed')
    assert 'PROGRAM Main IL\n' in editor.save(path)
    editor.finish()


def refused(screen):
    """what cannot be converted is told with its place, and a click leads there"""
    path = new_file(screen, REFUSED)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.command('Convert to Structured Text')
    says(editor, '“Main” cannot be shown as ST')
    reason = until(lambda: editor.all('"STOP" has no counterpart in ST'), 'the reason')[0]
    until(lambda: editor.all('Main, rung 2'), 'its place')
    editor.shot('show-refused')
    editor.click(reason)
    editor.to_sheet()
    until(lambda: editor.all('Rung 2'), 'the rung')
    editor.shot('show-there')
    editor.finish()


BELT = '''RUNGBOARD 1

PROGRAM Belt LD
RUNG
  | NO %IX0.3 | COIL %QX0.3 |
END_PROGRAM
'''


def included(screen):
    """a program of another file: the reason names that file, for each language, and leads to its page"""
    path = new_file(screen, PROGRAM.replace('\nPROGRAM', '\nINCLUDE "belt.rung"\n\nPROGRAM'))
    with open(os.path.join(os.path.dirname(path), 'belt.rung'), 'w') as other:
        other.write(BELT)
    editor = Editor(screen, path)
    row = until(lambda: [node for node in editor.all('Belt', 'label') if node.name == 'Belt'], 'the row in the tree')[0]
    editor.click(row, count=2)
    until(lambda: editor.all('%QX0.3'), 'the page')
    for key, language in ('ctrl+4', 'ST'), ('ctrl+3', 'IL'), ('ctrl+1', 'FBD'):
        editor.keys(key)
        says(editor, '“Belt” cannot be shown as ' + language)
        until(lambda: [node for node in editor.all('"Belt" stands in another file') if 'belt.rung' in node.name], 'the file')
        until(lambda: editor.all('LD787'), 'its code')
    editor.shot('show-included')
    assert not editor.all('is in LD and cannot'), 'the wrong reason'
    editor.finish()


def renamed(screen):
    """the page stays with its program when that gets another name, and follows it"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+4')
    says(editor, '“Main” as ST, read-only')
    row = [node for node in editor.all('Main', 'label') if node.name == 'Main' and node.box()[0] < 215][0]
    editor.click(row)
    editor.keys('F2')
    until(lambda: [node for node in editor.all(role='text') if node.has(12) and node.text() == 'Main'], 'the name to be asked for')
    editor.keys('ctrl+a')
    editor.type('Drive')
    editor.keys('Return')
    says(editor, '“Drive” as ST, read-only')
    until(lambda: [node for node in editor.all('Drive as ST') if node.name == 'Drive as ST'], 'the title of its tab')
    shows(editor, 'PROGRAM Drive ST', 'Motor := (Start OR Motor) AND NOT Stop;')
    editor.shot('show-renamed')
    editor.keys('ctrl+z')
    says(editor, '“Main” as ST, read-only')
    shows(editor, 'PROGRAM Main ST')
    editor.finish()


RUNS = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Late  AT %QX0.1 : BOOL;
  Level AT %IW2   : INT;
  Out   AT %QW2   : INT;
  Delay : TON;
END_VAR

PROGRAM Main LD
RUNG "The motor seals itself in"
  | NO Start  | NC Stop | COIL Motor |
  | NO Motor ^|
RUNG
  | NO Motor | TON Delay PT:=T#20ms | COIL Late |
RUNG
  | NC Motor | [ Level > 5 ] | [ Out := Level * 2 ] |
  | P Start ^|
END_PROGRAM
'''


def cell(editor, text):
    return until(lambda: [node for node in editor.all(role='table cell') if text in node.name], text)[0]


def live(screen):
    """networks of a ladder have power, values and why as the ladder has; a value is set there; also in a scan of the past"""
    path = new_file(screen, RUNS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+t')
    editor.says('SIMULATION')
    editor.to_sheet()
    editor.keys('ctrl+1')
    says(editor, '“Main” as FBD, read-only')
    cell(editor, 'OR, output 1: wire, FALSE')  # no variable has this value
    cell(editor, '>, output 1: wire, FALSE')
    editor.click(cell(editor, 'OR, input 1: Start, FALSE'))
    editor.says('Space: Toggle')
    editor.keys('space')
    cell(editor, 'OR, input 1: Start, TRUE')
    editor.keys('ctrl+t')
    cell(editor, 'OR, output 1: wire, TRUE')
    cell(editor, 'AND, output 1: wire, TRUE')
    cell(editor, 'Store in Motor, TRUE')
    cell(editor, 'R_EDGE, output 1: wire Start_rises, TRUE')  # in this scan alone
    editor.shot('live-networks')
    editor.keys('ctrl+t')
    cell(editor, 'R_EDGE, output 1: wire Start_rises, FALSE')
    editor.click(cell(editor, 'Store in Motor, TRUE'))
    editor.keys('ctrl+F12')
    says(editor, 'TRUE: (Start OR Motor) is true; and NOT Stop is true')
    editor.shot('live-why')
    editor.keys('alt+Left')
    cell(editor, 'R_EDGE, output 1: wire Start_rises, TRUE')
    editor.keys('alt+Left')
    cell(editor, 'OR, output 1: wire, FALSE')
    editor.keys('alt+End')
    cell(editor, 'OR, output 1: wire, TRUE')
    editor.click(cell(editor, 'OR, input 1: Start, TRUE'))
    editor.keys('space', 'ctrl+t')
    cell(editor, 'OR, input 1: Start, FALSE')
    cell(editor, 'OR, output 1: wire, TRUE')
    editor.click(cell(editor, 'OR, input 2: Motor, TRUE'))
    editor.keys('ctrl+shift+f')
    editor.says('1 force')
    editor.keys('ctrl+t')  # what is forced between two scans has power in the second one
    cell(editor, 'OR, output 1: wire, FALSE')
    editor.keys('ctrl+m')  # the simulation ends
    until(lambda: not [node for node in editor.all(role='table cell') if node.name.endswith('TRUE')], 'no values')
    editor.finish()


def back(screen):
    """a ladder of networks, and one of a chart, with power; values of a ladder as text"""
    path = new_file(screen, RUNS)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.command('Convert to networks')
    says(editor, '“Main” is in FBD now')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    editor.command('Show as ladder')
    says(editor, '“Main” as LD, read-only')
    coil = editor.element('Rung 1, COIL', 'Motor', 'off')
    assert pixels(editor, coil, POWER['light']) < 150
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    coil = editor.element('Rung 1, COIL', 'Motor', ', on')
    until(lambda: pixels(editor, coil, POWER['light']) > 150, 'power at the coil')
    editor.element('Rung 2, TON', '20 ms / 20 ms')
    editor.shot('live-ladder')
    editor.keys('ctrl+shift+f')
    editor.says('1 force')
    editor.finish()


def steps(screen):
    """the ladder of a chart that runs already: its steps have power"""
    editor = Editor(screen, new_file(screen, CHART))
    until(lambda: editor.all('Start'), 'the chart')
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    go = until(lambda: [node for node in editor.all('Go', 'check box') if node.box()[2] > 0], 'the panel')[0]
    editor.click(go)
    editor.command('Show as ladder')
    says(editor, '“Way” as LD, read-only')
    editor.element('NO', 'Run_X', 'closed')
    editor.element('NO', 'Start_X', 'open')
    editor.shot('live-steps')
    editor.click(go)
    editor.element('NO', 'Start_X', 'closed')
    editor.finish()


def tree(screen):
    """the menu of a row shows and converts the program of that row, in the languages that it can have"""
    path = new_file(screen, PROGRAM + '\nPROGRAM Belt ST\n  %QX0.3 := %IX0.3;\nEND_PROGRAM\n')
    editor = Editor(screen, path)
    editor.to_sheet()

    def choose(name, *entries):
        row = [node for node in editor.all(name, 'label') if node.name == name and node.box()[0] < 215][0]
        editor.click(row, button=3)
        until(lambda: editor.all('Duplicate…', 'menu item'), 'the menu of the row')
        for entry in entries:
            editor.find(entry, 'menu item').press()
    choose('Main', 'Show as', 'Show as networks')
    says(editor, '“Main” as FBD, read-only')
    editor.shot('show-tree')
    choose('Belt', 'Show as')
    until(lambda: editor.all('Show as instruction list', 'menu item'), 'a language')
    assert not editor.all('Show as networks', 'menu item'), 'Structured Text does not become networks'
    editor.shot('show-tree-menu')
    editor.find('Show as instruction list', 'menu item').press()
    says(editor, '“Belt” as IL, read-only')
    # The order changes while the menu is open: it is still that of its program.
    editor.click([node for node in editor.all('Belt', 'label') if node.name == 'Belt' and node.box()[0] < 215][0])
    editor.keys('alt+Up')
    says(editor, '“Belt” now runs first in each scan')
    choose('Main', 'Show as')
    entry = until(lambda: editor.all('Show as networks', 'menu item'), 'a language')[0]
    editor.find('Undo', 'push button').press()
    says(editor, 'Undone: ')
    entry.press()
    says(editor, '“Main” as FBD, read-only')
    choose('Main', 'Convert to', 'Convert to Structured Text')
    says(editor, '“Main” is in ST now')
    assert 'PROGRAM Main ST' in editor.save(path)
    editor.finish()


def chinese(screen):
    """a small window, in Chinese"""
    editor = Chinese(screen, new_file(screen, REFUSED))
    editor.to_sheet()
    editor.keys('ctrl+3')
    says(editor, '“Main”显示为 IL，只读')
    editor.shot('show-chinese')
    editor.keys('ctrl+4')
    says(editor, '“Main”无法显示为 ST')
    editor.shot('show-chinese-refused')
    editor.finish()


chinese.size = '1024x700x24'


def dark(screen):
    """networks as a ladder or as text, in the dark"""
    editor = Editor(screen, new_file(screen, CHART), ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    until(lambda: editor.all('Start'), 'the chart')
    editor.command('Show as ladder')
    says(editor, '“Way” as LD, read-only')
    until(lambda: editor.all('Way_Steps'), 'the ladders')
    until(lambda: editor.element('NO', 'Go'), 'the condition as a contact')
    until(lambda: editor.all('Program or block'), 'the list of its parts')
    editor.shot('show-dark')
    dark = darkest(editor.sheet())
    assert max(dark) < 64, 'the sheet is %s in the dark' % (dark,)
    editor.finish()


def networks(screen):
    """a ladder as networks and back: the same one"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+1')
    says(editor, '“Main” as FBD, read-only')
    editor.shot('show-networks')
    editor.find('Convert to networks', 'push button').press()
    says(editor, '“Main” is in FBD now')
    text = editor.save(path)
    assert 'PROGRAM Main FBD\n' in text and 'Motor := (Start OR Motor) AND NOT Stop\n' in text, text
    editor.command('Convert to ladder')
    says(editor, '“Main” is in LD now')
    assert editor.save(path) == PROGRAM
    editor.finish()


if __name__ == '__main__':
    main([shown, live, back, steps, converted, refused, included, renamed, tree, networks, chinese, dark])
