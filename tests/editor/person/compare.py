#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""compare - the project is compared with its saved state, another file and revisions in git."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import EDITOR, Editor, main, until  # noqa: E402

OLD = '''RUNGBOARD 1
PROJECT "Pump station"

VAR
  Start AT %IX0.0 : BOOL; (* push button *)
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
VAR
  Delay : TON;
END_VAR
RUNG Seal "Motor start and stop"
  | NO Start | NC Stop | COIL Motor |
  | NO Motor ^ |
RUNG "Run delay"
  | NO Motor | TON Delay PT:=T#5s | COIL Lamp |
RUNG "Test of the lamp"
  | NO %IX0.7 | COIL %QX0.7 |
END_PROGRAM

PROGRAM Tank SFC
  INITIAL_STEP Idle:
  END_STEP
  STEP Fill:
    %QX0.2(N);
  END_STEP
  TRANSITION FROM Idle TO Fill := Start; END_TRANSITION
  TRANSITION FROM Fill TO Idle := %IX0.3; END_TRANSITION
END_PROGRAM

PROGRAM List IL
  LD Start
  ANDN Stop
  ST %QX0.3
END_PROGRAM
'''
NEW = OLD.replace('Lamp AT %QX0.1', 'Lamp AT %QX0.5').replace('T#5s', 'T#8s').replace(
    '| NO Motor ^ |', '| NC Motor ^ |').replace('RUNG "Test of the lamp"\n  | NO %IX0.7 | COIL %QX0.7 |\n', '').replace(
    '%QX0.2(N)', '%QX0.2(S)').replace('ANDN Stop', 'AND Stop')
FRAME = bytes((0xb3, 0x5c, 0x00))  # changed boxes
SEAL = 'PROGRAM Main, Rung 1 (Seal), changed'


def write(path, text):
    with open(path, 'w') as file:
        file.write(text)


def git(folder, *words):
    subprocess.run(['git', '-C', folder, '-c', 'user.name=A', '-c', 'user.email=a@b.c', *words], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def project(screen):
    """A file with three revisions, the second of which cannot be read."""
    path = os.path.join(screen.home, 'pump.rung')
    git(screen.home, 'init', '-q')
    for text, subject in ((OLD, 'Draw the pump'), ('RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | what Start |\nEND_PROGRAM\n',
                                                  'Break it'), (NEW, 'Wait longer')):
        write(path, text)
        git(screen.home, 'add', 'pump.rung')
        git(screen.home, 'commit', '-q', '-m', subject)
    return path


def differences(editor):
    """The names of the rows of the list."""
    return [node.name for node in editor.all(role='list item') if ', changed: ' in node.name or
            ', removed: ' in node.name or ', added: ' in node.name]


def choose(editor, name):
    """Opens the dialog and takes a row of it."""
    window = editor.brought(lambda: editor.command('Compare'), 'Compare with')
    until(lambda: not editor.all('Asking git'), 'the answer of git')
    editor.shot('compare-dialog')
    row = editor.focus_on('The last saved state', 'list item')
    if name not in ('The last saved state', 'Another file…'):
        editor.keys('Tab')
        row = editor.focus_on(role='list item', but=row)
    while name not in row.name:
        editor.keys('Down')
        row = editor.focus_on(role='list item', but=row)
    editor.keys('Return')
    until(lambda: window not in editor.windows(), 'the end of the dialog')


def revisions(screen):
    """a revision in git is compared, stepped through by keys, and a rung is gone to; the page follows an undo"""
    editor = Editor(screen, project(screen))
    editor.to_sheet()
    choose(editor, 'Draw the pump')
    rows = until(lambda: differences(editor), 'the differences')
    editor.says('to “pump.rung, as it is now”')
    editor.shot('compare')
    assert rows[0].startswith('Symbols, Lamp, changed: address: %QX0.1 \N{RIGHTWARDS ARROW} %QX0.5'), rows
    assert any(row.startswith(SEAL + ': row 2, column A: NO Motor \N{RIGHTWARDS ARROW} NC Motor') for row in rows), rows
    editor.says('1 of %d' % len(rows))
    editor.keys('n')
    editor.says('2 of %d' % len(rows))
    editor.keys('n')
    editor.says('3 of %d' % len(rows))
    editor.shot('compare-rung')
    editor.keys('n')
    editor.says('4 of %d' % len(rows))
    assert not editor.find('Go to', 'push button').has(24), 'a rung that was removed is nowhere'
    editor.keys('p', 'p')
    editor.says('2 of %d' % len(rows))
    editor.shot('compare-seal')
    editor.keys('Return')
    editor.to_sheet()
    editor.says('Rung 1 · column A')
    editor.keys('ctrl+Delete')
    until(lambda: not editor.all('NC Motor', 'table cell'), 'the rung to go')
    editor.keys('ctrl+alt+n')
    until(lambda: any('Rung 1 (Seal), removed' in row for row in differences(editor)), 'the deleted rung')
    editor.keys('ctrl+z')
    editor.element('Rung 1, NC', 'Motor')
    editor.keys('ctrl+alt+n')
    until(lambda: any(SEAL in row for row in differences(editor)), 'the rung to differ again')
    for at in 'Step Fill, changed', 'Line 2, changed':
        assert any(at in row for row in rows), rows
    editor.find('Differences', 'list')
    editor.keys('End')
    editor.find('Line 2', 'picture')
    editor.keys('p')
    editor.find('Step Fill', 'picture')
    editor.says('%d of %d' % (len(rows) - 1, len(rows)))
    editor.keys('Up')  # goes on from the row of the picture
    editor.says('%d of %d' % (len(rows) - 2, len(rows)))
    editor.keys('n')
    editor.find('Step Fill', 'picture')
    editor.keys('Return')
    until(lambda: editor.find('Chart').has(12), 'the focus on the chart')
    editor.says('Step Fill')
    editor.shot('compare-chart')


def others(screen):
    """a revision that cannot be read shows why; the saved state has no differences until an edit; a file is compared"""
    path = project(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    choose(editor, 'Break it')
    editor.says('cannot be read:')
    editor.says('is not a known word')
    editor.shot('compare-unreadable')
    choose(editor, 'The last saved state')
    editor.says('No differences')
    editor.says('“pump.rung, as saved” and “pump.rung, as it is now” do not differ.')
    editor.shot('compare-equal')
    editor.keys(*['ctrl+Page_Up'] * 4)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'slash')
    editor.keys('ctrl+alt+n')
    until(lambda: any('NO Start \N{RIGHTWARDS ARROW} NC Start' in row for row in differences(editor)), 'the edit')
    editor.save(path)
    editor.says('No differences')
    other = os.path.join(screen.home, 'other.rung')
    write(other, OLD)
    chooser = editor.brought(lambda: choose(editor, 'Another file…'))
    editor.type_path(other)
    editor.keys('Return')
    until(lambda: chooser not in editor.windows(), 'the end of the chooser')
    editor.says('Changes from “other.rung” to “pump.rung, as it is now”')


def small(screen):
    """in a small dark window the drawings are one below the other; without git it says so"""
    folder = os.path.join(screen.home, 'plain')
    os.mkdir(folder)
    path = os.path.join(folder, 'pump.rung')
    write(path, NEW)
    editor = Editor(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark', PATH='/nowhere')
    editor.to_sheet()
    window = editor.brought(lambda: editor.command('Compare'), 'Compare with')
    editor.says('git is not installed.')
    editor.shot('compare-small-dialog')
    editor.keys('Return')
    until(lambda: window not in editor.windows(), 'the end of the dialog')
    editor.says('No differences')
    write(path, OLD)
    choose_saved(editor)
    until(lambda: len(differences(editor)) > 2, 'the differences')
    editor.keys('n')
    editor.shot('compare-small')


def choose_saved(editor):
    window = editor.brought(lambda: editor.command('Compare'), 'Compare with')
    editor.focus_on('The last saved state', 'list item')
    editor.keys('Return')
    until(lambda: window not in editor.windows(), 'the end of the dialog')


def rows_with(editor, text):
    return [row for row in differences(editor) if text in row]


def follows(screen):
    """an open page follows a save, a file that another program writes, and the I/O map, open or not"""
    path = project(screen)
    board = os.path.join(screen.home, 'pump.io')
    write(board, '%IX0.0  gpio  line=GPIO17\n')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash')
    choose_saved(editor)
    until(lambda: rows_with(editor, 'NC Start'), 'the edit')
    editor.save(path)
    editor.says('No differences')
    write(path, open(path).read().replace('T#8s', 'T#9s'))
    until(lambda: rows_with(editor, 'T#9s'), 'what the other program wrote')
    editor.shot('compare-follows')
    editor.click([node for node in editor.all('List', 'label') if node.name == 'List' and node.box()[0] < 200][0])
    editor.keys('Delete')  # an edit while the page is in front
    until(lambda: rows_with(editor, 'PROGRAM List, the whole POU, removed'), 'the program that is gone')
    editor.click(editor.find('pump.io', 'label'), count=2)
    editor.into('%IX0.0, I/O line')
    editor.keys('ctrl+a')
    editor.type('GPIO27')
    editor.keys('Return', 'ctrl+alt+n')
    until(lambda: rows_with(editor, 'I/O map, %IX0.0, changed: I/O line: GPIO17 \N{RIGHTWARDS ARROW} GPIO27'), 'the map as it is typed')
    write(board, '%IX0.0  gpio  line=GPIO18\n')
    until(lambda: rows_with(editor, 'GPIO18 \N{RIGHTWARDS ARROW} GPIO27'), 'the map that the other program wrote')
    write(board, '%IX0.0  gpio  line=GPIO27\n')
    until(lambda: not rows_with(editor, 'I/O map'), 'equal maps')


def two_files(screen):
    """two files are compared with no project open, by the command line and from the welcome page; lines of I/O maps too"""
    old, new = os.path.join(screen.home, 'old.rung'), os.path.join(screen.home, 'new.rung')
    write(old, OLD)
    write(new, NEW)
    write(old[:-4] + 'io', '%IX0.0 gpio line=GPIO17\n%QX0.0 gpio line=GPIO4 safe=0\n')
    write(new[:-4] + 'io', '%IX0.0 gpio line=GPIO27 # moved\n%QX0.5 gpio line=GPIO5 safe=0\n')
    editor = Editor(screen, '--compare', old, new)
    editor.says('Changes from “old.rung” to “new.rung”')
    until(lambda: rows_with(editor, SEAL), 'the rung')
    assert rows_with(editor, 'I/O map, %IX0.0, changed: I/O line: GPIO17 \N{RIGHTWARDS ARROW} GPIO27'), differences(editor)
    assert rows_with(editor, 'I/O map, %QX0.5, added: gpio line=GPIO5 safe=0'), differences(editor)
    assert rows_with(editor, 'I/O map, %QX0.0, removed'), differences(editor)
    editor.find('Differences', 'list')
    editor.keys('End')
    editor.shot('compare-maps')
    write(new[:-4] + 'io', open(old[:-4] + 'io').read())
    until(lambda: not rows_with(editor, 'I/O map'), 'the end of the differences of the maps')
    write(new, OLD)
    editor.says('No differences')
    write(new, NEW)
    until(lambda: rows_with(editor, SEAL), 'the rung again')
    before = editor.windows()
    editor.click(editor.find('Go to', 'push button'))
    until(lambda: [each for each in editor.windows() if each not in before] or editor.all('Sheet'), 'the file')
    editor.finish()
    editor = Editor(screen)
    editor.shot('compare-welcome')
    older = editor.brought(lambda: editor.click(editor.find('What differs between two versions of a project', 'label')), 'The older file')
    editor.type_path(new)
    newer = editor.brought('Return', 'The newer file')
    editor.type_path(old)
    editor.keys('Return')
    until(lambda: older not in editor.windows() and newer not in editor.windows(), 'the end of the choosers')
    editor.says('Changes from “new.rung” to “old.rung”')
    status = subprocess.run([EDITOR, '--compare', old], capture_output=True, text=True)
    assert status.returncode == 2 and 'needs two files' in status.stderr, status


small.size = '1024x700x24'
revisions.quick = 'editor-gtk/panels'
MORE = 'NETWORK "Only now"\n  Lamp := Valve\n'
NETS = '''RUNGBOARD 1

VAR
  Level AT %IW2   : INT;
  Valve AT %QX0.0 : BOOL;
  Lamp  AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main FBD
VAR
  Delay : TON;
END_VAR
NETWORK "Low level"
  Low := Level < 20
  Delay(IN := Low, PT := T#3s)
  Valve := Delay.Q
''' + MORE + 'END_PROGRAM\n'


def frames(editor):
    """How many pixels of frames and marks of changed boxes the sides before and after have."""
    x, y, width, height = editor.place()
    counts = []
    for left, right in (0.385, 0.68), (0.695, 0.99):
        body = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '%dx%d+%d+%d' % (
            width * (right - left), height * 0.6, x + width * left, y + height * 0.2), 'rgb:-'], capture_output=True).stdout
        counts.append(sum(body[at:at + 3] == FRAME for at in range(0, len(body), 3)))
    return counts


def networks(screen):
    """networks are drawn side by side, and changed boxes have a frame"""
    old, new = os.path.join(screen.home, 'old.rung'), os.path.join(screen.home, 'new.rung')
    write(old, NETS.replace('Level < 20', 'Level < 15').replace('T#3s', 'T#5s').replace(MORE, ''))
    write(new, NETS)
    editor = Editor(screen, '--compare', old, new)
    until(lambda: rows_with(editor, 'PROGRAM Main, Network 1 (Low level), changed: \N{MINUS SIGN} Low := Level < 15'),
          'the changed network')
    until(lambda: rows_with(editor, 'PROGRAM Main, Network 2 (Only now), added'), 'the new network')
    said = rows_with(editor, "Network 1 (Low level), changed")[0]
    assert 'Level < 20' in said and 'PT := T#5s' in said and 'PT := T#3s' in said, said
    until(lambda: min(frames(editor)) > 100, 'frames on both sides')
    before, after = frames(editor)
    assert abs(before - after) < before // 2, (before, after)  # two boxes on each side
    editor.shot('compare-networks')
    editor.keys('n')
    until(lambda: frames(editor)[0] == 0, 'nothing where the network was not')
    editor.shot('compare-networks-added')
    editor.keys('p')
    until(lambda: frames(editor) == [before, after], 'the frames again')
    write(new, NETS.replace('Level < 20', 'Level < 15').replace('T#3s', 'T#5s').replace(MORE, ''))
    editor.says('No differences')
    until(lambda: frames(editor) == [0, 0], 'no frame')
    editor.finish()


TESTS = [revisions, others, follows, two_files, small, networks]


if __name__ == '__main__':
    main(TESTS)
