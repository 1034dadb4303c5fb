#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""iomap - a person edits an I/O map as a table and runs a program with it on this machine."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import desk  # noqa: E402
from desk import BUILD, ROOT, Chinese, Editor, main, sh, until, urge  # noqa: E402
from node import ROLES  # noqa: E402

MAP = '''BOARD "Garage"
# Inputs: a contact to ground.

%IX0.0  sim  pull-up active-low   # the button
%IX0.1  gpio  line=GPIO5 debounce=5 years
%QX0.0  sim  safe=0   # up
'''


def garage(screen, text=MAP):
    """The garage door in its own folder, with a map; returns the paths of both."""
    path = os.path.join(screen.home, 'garage-door.rung')
    io = os.path.join(screen.home, 'garage-door.io')
    shutil.copy(os.path.join(ROOT, 'ladders', 'garage-door.rung'), path)
    with open(io, 'w') as file:
        file.write(text)
    return path, io


def open_map(editor, name='garage-door.io'):
    """From the tree at the left."""
    editor.find(name, 'label')
    editor.click(min(editor.all(name, 'label'), key=lambda node: node.box()[0]), count=2)
    editor.find('Name of the board')


def to_program(editor):
    """From the tree, whose rows may still move."""
    urge(lambda: any(sheet.has(12) for sheet in editor.all('Sheet')), lambda: editor.click(editor.find('Door', 'label'), count=2),
         'the sheet of the program')


def cell(editor, name):
    return editor.find(name, 'text')


def saved(io, text):
    until(lambda: open(io).read() == text, 'the map to be saved')


def shows(editor, name, value):
    until(lambda: cell(editor, name).text() == value, '%s to be "%s"' % (name, value))


def row_says(editor, name, text):
    until(lambda: [node for node in editor.all(name) if text in node.name], '%s to say "%s"' % (name, text))


def table(screen):
    """the table: problems are marked, a cell is edited, undone, saved; nothing else changes"""
    path, io = garage(screen)
    editor = Editor(screen, path)
    open_map(editor)
    until(lambda: editor.all('is not understood; write it like'), 'the problem of its row')
    editor.says('Used by the program, missing in the map: %IX0.2 StopOk')
    row_says(editor, '%IX0.0, sim', '. simulated')
    editor.click(cell(editor, '%IX0.1, Debounce'))
    editor.keys('ctrl+a')
    editor.type('2 s')
    editor.keys('Return')
    editor.says('It must be one word')
    assert not editor.all('•')
    editor.keys('ctrl+a')
    editor.type('20ms')
    editor.keys('Return')
    shows(editor, '%IX0.1, Debounce', '20ms')
    editor.shot('iomap-table')
    editor.keys('ctrl+s')
    saved(io, MAP.replace('5 years', '20ms years'))
    editor.keys('ctrl+z')
    shows(editor, '%IX0.1, Debounce', '5')
    editor.keys('ctrl+s')
    saved(io, MAP)
    editor.keys('ctrl+y')
    shows(editor, '%IX0.1, Debounce', '20ms')
    editor.click(editor.find('%IX0.0, Active low', 'check box'))
    editor.keys('ctrl+s')
    saved(io, MAP.replace('5 years', '20ms years').replace(' active-low   #', '              #'))


def undone(screen):
    """Ctrl+Z in a cell that is being edited takes the typed text first, then undoes it, before and after a save"""
    path, io = garage(screen)
    editor = Editor(screen, path)
    open_map(editor)
    for save in True, False:
        editor.click(cell(editor, '%IX0.0, Pull'))
        editor.keys('ctrl+a')
        editor.type('pull-down')
        editor.keys('Return')
        shows(editor, '%IX0.0, Pull', 'pull-down')
        if save:
            editor.keys('ctrl+s')
            saved(io, MAP.replace('pull-up', 'pull-down'))
        editor.click(cell(editor, '%QX0.0, Safe'))
        editor.keys('ctrl+a')
        editor.type('1')
        editor.keys('ctrl+z')
        shows(editor, '%QX0.0, Safe', '0')
        shows(editor, '%IX0.0, Pull', 'pull-down')
        editor.keys('ctrl+z')
        shows(editor, '%IX0.0, Pull', 'pull-up')
    editor.keys('ctrl+s')
    saved(io, MAP)


def choices(screen):
    """values for a cell are offered, by pointer and by key; points are added and deleted"""
    path, io = garage(screen, 'BOARD "Desk"\n%IX0.0  sim\n%QX0.0  sim  safe=0')
    editor = Editor(screen, path)
    open_map(editor)
    x, y, width, height = editor.place(cell(editor, '%IX0.0, Pull'))
    editor.click((x + width - 10, y + height // 2))
    editor.shot('iomap-choices')
    editor.find('pull-down a resistor', 'list item')
    editor.keys('Down', 'Down', 'Return')
    shows(editor, '%IX0.0, Pull', 'pull-down')
    editor.keys('Tab')
    editor.click(cell(editor, '%QX0.0, Safe'))
    editor.keys('alt+Down')
    editor.find('1 on while nothing runs', 'list item')
    editor.keys('Down', 'Return')
    shows(editor, '%QX0.0, Safe', '1')
    editor.keys('ctrl+s')
    saved(io, 'BOARD "Desk"\n%IX0.0  sim pull-down\n%QX0.0  sim  safe=1')
    editor.click(editor.find('Add them', 'push button'))
    cell(editor, '%QX0.1, Driver')
    until(lambda: not editor.all('Add them'), 'nothing to be missing')
    editor.shot('iomap-added')
    editor.click(cell(editor, '%QX0.0, Comment'))
    editor.type('up')
    editor.keys('Return')
    shows(editor, '%QX0.0, Comment', 'up')
    editor.click(editor.find('Delete the line'))
    until(lambda: not editor.all('%QX0.0, Comment'), 'the point to be gone')
    editor.keys('ctrl+s')
    until(lambda: '%QX0.1  sim  safe=0   # MotorDown' in open(io).read(), 'the map')
    assert '%QX0.0' not in open(io).read() and '%IX0.5  sim   # BeamOk\n' in open(io).read()


def given_up(screen):
    """a refused value, by Return and by leaving: its message goes when the value is dropped; texts stay at their place"""
    path, io = garage(screen, 'BOARD "Desk"\n%QX0.0  sim  safe=0\n%QX0.1  sim  safe=0\n')
    editor = Editor(screen, path)
    open_map(editor)
    before = editor.place(cell(editor, '%QX0.0, Safe'))
    for way in 'Return', 'Tab':
        editor.click(cell(editor, '%QX0.0, Safe'))
        editor.keys('ctrl+a')
        editor.type('7')
        editor.keys(way)
        editor.says('%QX0.0, Safe: This is not one of the choices')
        editor.shot('iomap-refused-' + way)
        editor.click(cell(editor, '%QX0.0, Safe'))
        editor.keys('Escape')
        until(lambda: not editor.all('This is not one of the choices'), 'nothing to be told')
        shows(editor, '%QX0.0, Safe', '0')
    assert editor.place(cell(editor, '%QX0.0, Safe')) == before
    # The arrow shows the choices; it is back at its place and whole.
    x, y, width, height = editor.place(cell(editor, '%QX0.0, Safe'))
    editor.click((x + width - 12, y + height // 2))
    editor.shot('iomap-given-up')
    editor.find('1 on while nothing runs', 'list item')
    editor.keys('Escape')
    editor.click(cell(editor, '%QX0.0, Debounce'))
    editor.type('2 s')
    editor.keys('Return')
    editor.says('It must be one word')
    editor.keys('ctrl+a', 'BackSpace', 'Tab')
    until(lambda: not editor.all('It must be one word'), 'nothing to be told')
    assert not editor.all('•')


def added(screen):
    """+: the cell of the new address has the keys, its text selected"""
    path, io = garage(screen, 'BOARD "Desk"\n%QX0.0  sim  safe=0\n')
    editor = Editor(screen, path)
    open_map(editor)
    editor.click(cell(editor, '%QX0.0, Comment'))
    point = None
    for address in '%QX7.0', '%QX7.1':
        editor.click(editor.find('Add a line', 'push button'))
        point = editor.focus_on(', Address', 'text', but=point)
        editor.type(address)  # the old text was selected
        time.sleep(0.3)  # the table is read again meanwhile
        editor.keys('Return')
        shows(editor, address + ', Address', address)
    editor.shot('iomap-added-point')
    editor.keys('ctrl+s')
    until(lambda: '%QX7.0  sim' in open(io).read() and '%QX7.1  sim' in open(io).read(), 'the map')


def as_text(screen):
    """the map as text: a wrong line and its place, which the table cannot show; closing asks before anything is lost"""
    path, io = garage(screen)
    editor = Editor(screen, path)
    open_map(editor)
    until(lambda: not editor.all(' · column', 'label'), 'no place in a table')
    editor.keys('ctrl+g')
    editor.says('There are no rungs or lines to go to')
    editor.click(editor.find('Text', 'page tab'))
    editor.says('Line 5: ')
    place = editor.find(' · column', 'label').name
    assert place.startswith('Line '), place
    editor.into('garage-door.io')
    editor.keys('ctrl+End')
    editor.type('%QX0.1 sim')
    editor.shot('iomap-text')
    editor.click(editor.find('Table', 'page tab'))
    cell(editor, '%QX0.1, Driver')
    until(lambda: not editor.all(' · column', 'label'), 'the place to be gone')
    editor.shot('iomap-no-place')
    editor.keys('ctrl+q', 'ctrl+w')
    editor.find('Save', 'push button').press()
    saved(io, MAP + '%QX0.1 sim')


def new_map(screen):
    """a new map has a point for each input and output of the program"""
    path, io = garage(screen)
    os.unlink(io)
    editor = Editor(screen, path)
    editor.brought(lambda: editor.command('New I/O map'), 'New I/O map')
    editor.keys('Return')
    io = os.path.join(screen.home, 'garage-door.io')
    until(lambda: os.path.exists(io), 'the file')
    editor.find('garage-door.io', 'label')
    cell(editor, '%IX0.0, Driver')
    editor.shot('iomap-new')
    text = open(io).read()
    assert text.startswith('BOARD "Garage door"\n\n%IX0.0  sim   # ButtonUp\n'), text
    assert '%QX0.0  sim  safe=0   # MotorUp\n' in text and text.count('\n') == 13, text


def child(editor):
    """The ladderd process that the editor started; None: there is none."""
    found = subprocess.run(['pgrep', '-P', str(editor.pid), 'ladderd'], capture_output=True, text=True).stdout
    return int(found) if found else None


def is_gone(pid):
    try:
        with open('/proc/%d/stat' % pid) as stat:
            return stat.read().rsplit(')', 1)[1].split()[0] == 'Z'
    except FileNotFoundError:
        return True


SIM = 'BOARD "Desk"\n' + ''.join('%%IX0.%d  sim\n' % i for i in range(7)) + ''.join(
    '%%QX0.%d  sim  safe=0\n' % i for i in range(4))


def running(screen, text=SIM):
    path, io = garage(screen, text)
    editor = Editor(screen, path)
    editor.command('Run on this machine')
    return editor, io


def run_board(screen):
    """run on this machine with simulated pins: state, log, stop; unsaved work is saved first"""
    editor, io = running(screen)
    editor.says('RUN')
    until(lambda: editor.all('ON THIS MACHINE', 'label'), 'the state of the window')
    until(lambda: editor.all(' us, at worst ', 'label'), 'the times of scans')
    assert 'Started with garage-door.io' in editor.find('Messages of ladderd', 'text').text()
    editor.shot('board-run')
    pid = child(editor)
    assert pid
    with open('/proc/%d/environ' % pid) as environ:  # the variables that avoid GL in the editor are not for other programs
        assert 'GDK_DEBUG' not in environ.read()
    editor.click(editor.find('Stop', 'push button'))
    until(lambda: 'Ended; outputs have their safe values' in
          editor.find('Messages of ladderd', 'text').text(), 'its end in the log')
    editor.find('OFF', 'label')
    for line in 'Started with garage-door.io', 'RUN', 'STOPPING', 'Ended; outputs have their safe values':
        log = editor.logs('communication', line)
    assert log.count('RUN') == 1, log
    editor.shot('board-log')
    editor.tab('Board')
    assert is_gone(pid) and not editor.all('ON THIS MACHINE')
    open_map(editor)
    editor.click(cell(editor, '%IX0.0, Comment'))
    editor.type('first')
    editor.keys('Return')
    shows(editor, '%IX0.0, Comment', 'first')
    editor.click(editor.find('Run on this machine', 'push button'))
    editor.find('Run on this machine?')
    editor.shot('board-ask')
    editor.find('Save and run', 'push button').press()
    saved(io, SIM.replace('%IX0.0  sim', '%IX0.0  sim   # first'))
    editor.says('RUN')


def described(editor):
    """The text of the question, and its default button."""
    dialog = editor.find(role='dialog')
    until(lambda: editor.focused() and editor.focused().role == ROLES['push button'], 'the focus in the question')
    return ' '.join(node.name for node in editor.all(role='label', below=dialog.path)), editor.focused().name


def not_its_own(screen):
    """a map of another program is used only after a question that names both, with Cancel as default; its own map replaces it"""
    path, io = garage(screen, SIM)
    other = io.replace('garage-door', 'press')
    os.rename(io, other)
    editor = Editor(screen, path)
    for text, pins in (SIM, None), (SIM.replace('%IX0.0  sim', '%IX0.0  gpio  line=NOWHERE'), 'It reads 1 pin and drives 0 pins.'):
        with open(other, 'w') as file:
            file.write(text)
        editor.to_sheet()
        editor.command('Run on this machine')
        said, button = described(editor)
        assert 'press.io is not the I/O map of this project, which is named garage-door.io' in said, said
        assert pins in said if pins else 'It reads' not in said, said
        assert button.startswith('Cancel'), button
        editor.shot('board-not-its-own')
        editor.keys('Return')
        until(lambda: not editor.all(role='dialog'), 'the question to be gone')
        assert not child(editor) and not editor.all('Started with')
    with open(other, 'w') as file:
        file.write(SIM)
    editor.command('Run on this machine')
    editor.answer('Run')
    editor.says('RUN')
    assert 'Started with press.io' in editor.find('Messages of ladderd', 'text').text()
    editor.click(editor.find('Stop', 'push button'))
    editor.find('OFF', 'label')
    # Missing points are added from there; then it runs without a question.
    editor.click(editor.find('Run…', 'push button'))
    editor.brought(lambda: editor.reply('New I/O map…'), 'New I/O map')
    editor.keys('Return')
    until(lambda: os.path.exists(io), 'the map')
    cell(editor, '%IX0.0, Driver')
    to_program(editor)
    editor.to_sheet()
    editor.command('Run on this machine')
    until(lambda: 'Started with garage-door.io' in editor.find('Messages of ladderd', 'text').text(), 'that it runs with it')


def no_longer(screen):
    """the bar "no I/O map beside the program" closes when a map is made; a run removes what a killed editor left, and no more"""
    left, other = (tempfile.mkdtemp(prefix='rungboard-run-') for _ in range(2))
    for file in left + '/group', other + '/mine':
        open(file, 'w').close()
    for folder in left, other:
        os.utime(folder, (1, 1))
    path, io = garage(screen)
    os.unlink(io)
    editor = Editor(screen, path)
    for make in lambda: editor.command('New I/O map'), None:
        editor.to_sheet()
        editor.command('Run on this machine')
        editor.says('The program has no I/O map')
        if make:
            editor.brought(make, 'New I/O map')
            editor.keys('Return')
            cell(editor, '%IX0.0, Driver')
        else:
            with open(io, 'w') as file:
                file.write(SIM)
        until(lambda: not editor.all('The program has no I/O map', 'label'), 'the bar to be gone')
        if make:
            editor.keys('ctrl+shift+w')
            until(lambda: not editor.all('%IX0.0, Driver'), 'the page to be gone')
            os.unlink(io)
            to_program(editor)
    editor.to_sheet()
    editor.command('Run on this machine')
    editor.says('RUN')
    assert not editor.all('The program has no I/O map', 'label')
    assert not os.path.exists(left) and os.path.exists(other + '/mine')
    shutil.rmtree(other)


def close_board(screen):
    """closing the window asks and stops the program first; a wrong map is refused with the reason"""
    editor, io = running(screen, SIM + '%QX0.9  sim\n')
    editor.says('Could not start. See the messages below.')
    until(lambda: 'LD502' in editor.find('Messages of ladderd', 'text').text(), 'the reason')
    editor.shot('board-refused')
    for line in 'LD502', 'ladderd ended with status', 'Could not start.':
        editor.logs('communication', line)
    editor.tab('Board')
    with open(io, 'w') as file:
        file.write(SIM)
    editor.click(editor.find('Run…', 'push button'))
    until(lambda: editor.all('RUN', 'label'), 'that it runs')
    until(lambda: not editor.all('Could not start'), 'the bar to be gone')
    pid = child(editor)
    editor.keys('ctrl+w')
    editor.find('Stop the program on this machine?')
    editor.find('Cancel', 'push button').press()
    until(lambda: not editor.all('Stop and close'), 'the question to be gone')
    assert not is_gone(pid)
    editor.keys('ctrl+w')
    editor.find('Stop and close', 'push button').press()
    until(lambda: editor.process.poll() is not None, 'the editor to end')
    assert editor.process.returncode == 0 and is_gone(pid)


def lost(screen):
    """a program that stops by itself or is lost is logged with the reason"""
    path, io = garage(screen, 'BOARD "Desk"\n%IX0.0  sim\n%QX0.0  sim  safe=0\n')
    with open(path, 'w') as file:
        file.write('RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NC %IX0.0 | STOP |\nRUNG\n'
                   '  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n')
    editor = Editor(screen, path)
    editor.command('Run on this machine')
    editor.logs('communication', 'STOP: ')
    os.kill(child(editor), signal.SIGKILL)
    editor.logs('communication', 'ladderd was ended by a signal')
    editor.shot('board-lost')


def killed(screen):
    """a killed editor leaves no running process"""
    editor, _ = running(screen)
    editor.says('RUN')
    pid = child(editor)
    assert pid and not is_gone(pid)
    editor.kill()
    until(lambda: is_gone(pid), 'ladderd to end')


FAKE = os.path.join(BUILD, 'tests', 'hal', 'editor_v2')
LINES = '''BOARD "Panel"
%IX0.0  gpio  line=IN0
%IX0.1  gpio  line=NOWHERE
%IX0.2  gpio  chip=panel offset=0
%IX0.3  gpio  chip=rest offset=0
%QX0.0  gpio  line=OUT0  safe=0
'''


def lines_here(screen):
    """lines of this machine (fake chips) are offered, named, and marked if unavailable; no ladderd"""
    if not os.path.exists(FAKE):
        return
    dev = os.path.join(screen.home, 'dev')
    os.mkdir(dev)
    for chip in ('gpiochip0', 'gpiochip1'):
        open(os.path.join(dev, chip), 'w').close()
    desk.EDITOR = FAKE
    path, io = garage(screen, LINES)
    editor = Editor(screen, path, FAKE_DEV=dev, PATH='')
    open_map(editor)
    for name, text in (('%IX0.0', 'gpiochip0 0'), ('%IX0.1', '"NOWHERE": this machine has no such line'),
                       ('%IX0.2', 'is used twice in the map, first for %IX0.0'),
                       ('%IX0.3', 'is in use by'), ('%QX0.0', 'gpiochip0 2')):
        row_says(editor, name + ', gpio', text)
    editor.click(cell(editor, '%IX0.1, I/O line'))
    editor.keys('alt+Down')
    editor.find('IN1 gpiochip0 (panel) 1, free', 'list item')
    editor.find('rest 0 gpiochip1 (rest) 0, in use', 'list item')
    editor.shot('iomap-lines')
    editor.keys('Down', 'Return')
    shows(editor, '%IX0.1, I/O line', 'IN1')
    row_says(editor, '%IX0.1, gpio', 'gpiochip0 1')
    editor.keys('ctrl+s')
    saved(io, LINES.replace('line=NOWHERE', 'line=IN1'))
    editor.click(editor.find('Run on this machine', 'push button'))
    editor.find('It reads 4 pins and drives 1 pin.')
    editor.find('Run', 'push button').press()
    editor.says('ladderd, which runs programs on pins, was not found')
    editor.logs('communication', 'ladderd, which runs programs on pins, was not found')


def in_chinese(screen):
    """table and board page in Chinese, dark, 1024 x 700"""
    path, io = garage(screen)
    with open(io, 'w') as file:
        file.write(SIM)
    editor = Chinese(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    open_map(editor)
    editor.click(editor.find('在本机运行', 'push button'))
    until(lambda: editor.all('RUN', 'label'), 'that it runs')
    editor.find('扫描次数', 'label')
    until(lambda: editor.all('，最长 ', 'label'), 'the times of scans')
    editor.shot('iomap-chinese')
    assert editor.find('停止', 'push button')


in_chinese.size = '1024x700x24'
table.quick = 'editor-gtk/iomap'
if __name__ == '__main__':
    main([table, undone, choices, given_up, added, as_text, new_map, run_board, not_its_own, no_longer, close_board, lost, killed, lines_here, in_chinese])
