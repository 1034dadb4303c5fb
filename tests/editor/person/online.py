#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online - the third mode of the window: connecting to a board, its state, download, upload, comparison.

The boards are real ladderds of this machine, whose lines are simulated.
"""
import os
import re
import signal
import socket
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../online'))
from link import Sshd  # noqa: E402
from screen import close_window  # noqa: E402
from desk import BUILD, Editor, check, main, new_file, until  # noqa: E402

SEAL = '''RUNGBOARD 1
PROJECT "Seal"

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Count : INT;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
'''
MAP = 'BOARD "garage"\n%IX0.0 sim\n%QX0.0 sim\n'


class Board:
    """A ladderd with --link in a folder of its own. The screen ends it if a test fails."""

    def __init__(self, screen, name, program=SEAL, role='eng', board=MAP, options=(), daemon='ladderd', env=None):
        self.screen, self.options = screen, options
        self.ladderd, self.env = os.path.join(os.path.abspath(BUILD), daemon), {**os.environ, **(env or {})}
        self.folder = os.path.join(screen.home, name)
        os.makedirs(self.folder + '/slots')
        self.arguments = ['board.rung', '--io', 'board.io'] if program else ['', '--io', '']
        for file, text in (('board.rung', program or ''), ('board.io', board), ('group', ''.join('ladder-%s:x:%d:\n' % (it, os.getgid()) for it in role.split()))):
            with open(os.path.join(self.folder, file), 'w') as out:
                out.write(text)
        self.where = 'unix:%s/link' % self.folder
        os.chmod(self.folder, 0o755)
        self.start()

    def write(self, name, text):
        with open(os.path.join(self.folder, name), 'w') as out:
            out.write(text)

    def start(self):
        self.daemon = subprocess.Popen(
            [self.ladderd, *self.arguments, '--link', 'link', '--groups', 'group',
             '--slots', 'slots', *self.options], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, env=self.env)
        self.screen.running.append(self.daemon)
        until(self.listens, 'the board')

    def listens(self):
        with socket.socket(socket.AF_UNIX) as desk:
            return desk.connect_ex(self.folder + '/link') == 0

    def stop(self):
        self.daemon.send_signal(signal.SIGTERM)
        self.daemon.wait()
        if os.path.exists(self.folder + '/link'):
            os.unlink(self.folder + '/link')

    def ask(self, *words):
        return subprocess.run([os.path.join(os.path.abspath(BUILD), 'ladder'), 'board', self.where, *words],
                              capture_output=True, text=True, check=True).stdout


def connect(editor, where):
    """By keys alone: the dialog's line has the focus."""
    editor.keys('ctrl+shift+m')
    until(lambda: editor.all('Connect to a board'), 'the dialog')
    editor.into('Board')
    editor.keys('ctrl+a')
    editor.type(where)
    editor.keys('Return')


def says(editor, text):
    until(lambda: [node for node in editor.all(text, 'label') if text in node.name], text)


def press(editor, name, role='push button'):
    """The button of exactly that name; one of a dialog is found by its label."""
    editor.click(until(lambda: [node for node in editor.all(name, role) if node.name == name], name)[0])


def shown_log(editor):
    return next(node.text() for node in editor.all('Log', 'text'))


def state(screen):
    """connecting by keys: the bar says board, mode and whether it runs this program; Stop and Run; a break is mended"""
    board = Board(screen, 'garage')
    editor = Editor(screen, new_file(screen, SEAL, 'seal.rung'))
    editor.to_sheet()
    connect(editor, 'nonsense -x')
    says(editor, 'Write USER@BOARD')
    editor.keys('ctrl+a')
    editor.type(board.where)
    editor.keys('Return')
    says(editor, 'garage · RUN')
    says(editor, 'The board runs this program.')
    editor.shot('online-same')
    press(editor, 'Stop')
    editor.find('Stop the program on “garage”?', 'label')
    editor.shot('online-stop')
    editor.keys('Return')
    says(editor, 'garage · STOP')
    assert 'mode: STOP' in board.ask('status')
    press(editor, 'Run')
    editor.find('Run the program on “garage”?', 'label')
    editor.keys('Return')
    says(editor, 'garage · RUN')
    log = editor.logs('operator', 'ordered STOP')
    assert re.search(r'\tsystem\tgarage: STOP, outputs are safe', log) and re.search(r'\tcommunication\tgarage · RUN', log)
    press(editor, 'Operator')
    until(lambda: 'ordered' not in shown_log(editor), 'the lines of the operator to be hidden')
    assert '\tsystem\tgarage: STOP' in shown_log(editor)
    press(editor, 'Operator')
    until(lambda: shown_log(editor).startswith(log), 'all lines again')
    board.ask('force', 'Motor=1')
    editor.command('State of the board')
    says(editor, 'Missed scans')
    says(editor, 'Speed of the board, words/ms')
    until(lambda: 'Held at, Without the force, Motor, TRUE, FALSE' in ', '.join(node.name for node in editor.all(role='label')),
          'the force of Motor')
    # The clock of the board is that of this computer; the test only looks at the question.
    says(editor, 'as on this computer')
    press(editor, 'Set clock…')
    editor.find('Set the clock of “garage”?', 'label')
    editor.shot('online-clock')
    editor.keys('Escape')
    editor.shot('online-device')
    board.ask('unforce', 'Motor')
    until(lambda: not editor.all('Held at', 'label'), 'the force to be gone')
    commands = editor.list_commands()
    other = editor.find('About Rungboard', 'list item')
    editor.type('Stop the board')
    until(lambda: other.path not in editor.shown(other.parent), 'that command alone')
    board.stop()
    says(editor, 'connection lost')
    editor.keys('Return')
    until(lambda: commands not in editor.windows(), 'the end of the list')
    says(editor, 'The board does not answer.')
    says(editor, 'NOT CONNECTED')
    editor.shot('online-lost')
    board.start()
    says(editor, 'garage · RUN')
    editor.click(editor.find('Disconnect', 'push button'))
    until(lambda: not editor.all('garage · RUN'), 'the bar to go')
    board.stop()


ALARMS = '''RUNGBOARD 1
PROJECT "Seal"

PROGRAM Main LD
VAR
  Hot : ALARM := (MSG := 'too hot');
  Low : ALARM := (MSG := 'oil is low');
END_VAR
RUNG
  | NC SYS_IO_FAULT | ALARM Hot |
RUNG
  | NC SYS_IO_FAULT | ALARM Low |
END_PROGRAM
'''


def alarms(screen):
    """the alarms of a board: one is acknowledged by its row, all with the pointer; what is refused stays on show"""
    board = Board(screen, 'garage', ALARMS)
    editor = Editor(screen, new_file(screen, ALARMS, 'alarms.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'garage · RUN')
    editor.tab('Alarms')
    editor.says('2 active, 2 to acknowledge')
    editor.shot('online-alarms')
    editor.click(editor.find('Acknowledge all', 'push button'))
    editor.says('2 active, 0 to acknowledge')
    assert board.ask('alarms').count('; acknowledged by ') == 2, board.ask('alarms')
    editor.shot('online-alarms-acked')


def roles(screen):
    """a user who may only look gets values and a reason at each button; a user without a group is told what to do"""
    board = Board(screen, 'porch', role='view')
    path = new_file(screen, SEAL, 'seal.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path)
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'you may look')
    button = editor.find('Download…', 'push button')
    assert not button.has(24) or not button.has(8), 'Download can be pressed'
    editor.shot('online-view')
    board.stop()
    board = Board(screen, 'cellar', role='none')
    connect(editor, board.where)
    says(editor, 'none of the groups')
    editor.shot('online-none')
    connect(editor, 'unix:/nowhere')
    says(editor, 'No ladderd listens at “/nowhere”')
    board.stop()
    board = Board(screen, 'shed', program=None)
    connect(editor, board.where)
    says(editor, 'The board has no program.')
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+shift+l')
    editor.find('The board has no program yet, so there are no values to keep.', 'label')
    assert not editor.all('All values go on', 'label')
    editor.shot('online-empty')
    editor.keys('Return')
    says(editor, 'The board runs this program.')
    assert 'mode: STOP' in board.ask('status')
    board.stop()


def download(screen):
    """a change is marked until it is downloaded; the dialog names what loses its value; no scan is missed"""
    board = Board(screen, 'mill', options=('--period', '500ms'))  # a busy machine may be late by some ms
    path = new_file(screen, SEAL.replace('Count : INT', 'Total : DINT'), 'seal.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path)
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'The board runs another program.')
    editor.says('Values of the board are not shown: ')
    log = editor.logs('communication', 'its program was read to show values')
    assert 'read the program' not in log, log
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+shift+l')
    editor.find('Download to “garage”?', 'label')
    says(editor, '“Count” is not in the new program; its value is lost')
    editor.shot('online-download')
    assert not editor.all('Total” is new'), 'a new variable loses nothing'
    board.daemon.send_signal(signal.SIGSTOP)
    editor.keys('Return')
    until(lambda: not editor.all('Download to “garage”?', 'label'), 'the end of the dialog')
    editor.keys('ctrl+shift+l')
    editor.says('The board has not answered to the last download yet')
    board.daemon.send_signal(signal.SIGCONT)
    says(editor, 'The board runs this program.')
    editor.logs('operator', 'Downloaded to “garage”')
    assert 'mode: RUN' in board.ask('status')
    before = int(re.search(r'missed scans: (\d+)', board.ask('status'))[1])
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+d', 'ctrl+shift+l')
    editor.find('Download to “garage”?', 'label')
    editor.keys('Return')
    says(editor, 'The board runs this program.')
    scans = board.ask('status')
    assert int(re.search(r'missed scans: (\d+)', scans)[1]) == before, scans
    editor.keys('ctrl+z')
    says(editor, 'Changed here, not downloaded.')
    editor.keys('ctrl+shift+l')
    editor.find('Download to “garage”?', 'label')
    editor.keys('Return')
    says(editor, 'The board runs this program.')
    scans = board.ask('status')
    assert int(re.search(r'missed scans: (\d+)', scans)[1]) == before, scans
    assert 'Total' in board.ask('symbols')
    editor.to_sheet()
    editor.keys('ctrl+d')
    says(editor, 'Changed here, not downloaded.')
    press(editor, 'Compare')
    editor.find('garage, on the board')
    editor.shot('online-compare')
    folder = os.path.join(screen.home, 'uploaded')
    os.makedirs(folder)
    editor.give_path(folder, lambda: press(editor, 'Upload…'), 'Folder')
    until(lambda: os.path.exists(folder + '/seal.rung'), 'the program of the board')
    assert open(folder + '/seal.rung').read() == open(path).read() and open(folder + '/seal.io').read() == MAP
    until(lambda: len(editor.windows()) == 2, 'its window')
    says(editor, 'The board runs this program.')  # its window is connected, too
    until(lambda: len(editor.all('garage · RUN', 'label')) == 2, 'the board in both windows')
    editor.shot('online-uploaded')
    board.stop()


def nothing(screen):
    """a board that stores no sources gives lists made from its code"""
    board = Board(screen, 'attic')
    editor = Editor(screen, new_file(screen, SEAL, 'seal.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'The board runs this program.')
    folder = os.path.join(screen.home, 'lists')
    os.makedirs(folder)
    editor.give_path(folder, lambda: press(editor, 'Upload…'), 'Folder')
    says(editor, 'The board stores no sources')
    until(lambda: os.path.exists(folder + '/program.rung'), 'its program as lists')
    assert 'PROGRAM Main IL' in open(folder + '/program.rung').read()
    until(lambda: len(editor.windows()) == 2, 'its window')
    editor.shot('online-no-sources')
    board.stop()


def remains(screen):
    """the board runs on when the window is closed"""
    board = Board(screen, 'attic')
    editor = Editor(screen, new_file(screen, SEAL, 'seal.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'The board runs this program.')
    close_window(int(editor.window))
    until(lambda: editor.process.poll() is not None, 'the editor to end')
    assert 'mode: RUN' in board.ask('status'), 'closing the window stopped the machine'
    board.stop()


def children(pid):
    """The ladderds that the editor has started."""
    out = subprocess.run(['pgrep', '-P', str(pid), 'ladderd'], capture_output=True, text=True).stdout
    return [int(number) for number in out.split()]


def here(screen):
    """Run on this machine is the same mode: the window is connected to what runs, and a change goes there without a stop"""
    path = new_file(screen, SEAL, 'seal.rung')
    with open(path[:-5] + '.io', 'w') as out:
        out.write(MAP)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.tab('Board')
    editor.click(editor.find('Run…', 'push button'))
    says(editor, 'garage · RUN')
    says(editor, 'The board runs this program.')
    with open('/proc/%d/cmdline' % children(editor.pid)[0]) as words:
        folder = os.path.dirname(next(word for word in words.read().split('\0') if word.endswith('/link')))
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+d')
    says(editor, 'Changed here, not downloaded.')
    editor.shot('online-here')
    editor.keys('ctrl+shift+l')
    says(editor, 'Download to “garage”?')
    editor.keys('Return')
    says(editor, 'The board runs this program.')
    editor.tab('Board')
    press(editor, 'Stop')
    until(lambda: not editor.all('garage · '), 'the bar to go')
    until(lambda: not os.path.exists(folder), 'the end of its folder')


def ssh(screen):
    """ssh's questions come as dialogs: an unknown board, a passphrase; another key than before is refused"""
    if not os.path.exists('/usr/sbin/sshd') or not os.path.exists(os.path.join(BUILD, 'tests/online/ladder-attach')):
        return
    board = Board(screen, 'far')
    server = Sshd(board)
    subprocess.run(['ssh-keygen', '-q', '-p', '-P', '', '-N', 'open sesame', '-f', board.folder + '/key'], check=True)
    os.unlink(board.folder + '/known')
    board.write('config', 'Host *\n Port %d\n IdentityFile %s/key\n IdentitiesOnly yes\n IdentityAgent none\n'
                ' UserKnownHostsFile %s/known\n' % (server.port, board.folder, board.folder))
    editor = Editor(screen, new_file(screen, SEAL, 'seal.rung'), RUNGBOARD_SSH='ssh -F %s/config' % board.folder)
    editor.to_sheet()
    connect(editor, '127.0.0.1')
    says(editor, 'fingerprint is SHA256:')
    editor.shot('online-unknown')
    editor.keys('Tab', 'Return')  # the keys are at Cancel
    says(editor, 'Enter passphrase for key')
    until(lambda: any(node.has(12) for node in editor.all('Enter passphrase')), 'the keys in the line')
    editor.shot('online-passphrase')
    editor.type('open sesame')
    editor.keys('Return')
    says(editor, 'garage · RUN')
    with open(editor.log) as log:
        assert 'sesame' not in log.read()
    press(editor, 'Disconnect')
    server.trust('other')
    connect(editor, '127.0.0.1')
    says(editor, 'shows another key than before, so nothing was sent')
    editor.shot('online-other-key')
    server.close()
    board.stop()


if __name__ == '__main__':
    main([state, roles, alarms, download, nothing, remains, here, ssh])
