#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online_field - the inputs and outputs of a connected board: live values, and how good they are, wherever a person looks.

The board is a ladderd of this machine. Its gateway is the client made from docs/online.md.
"""
import os
import socket
import struct
import sys
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, main, until  # noqa: E402
from iomap import row_says  # noqa: E402
from iomap_pages import open_map  # noqa: E402
from online import Board, connect, press, says  # noqa: E402
import client  # noqa: E402  of tests/online, whose folder online.py adds

PROGRAM = '''RUNGBOARD 1
PROJECT "Plant"

VAR
  Level AT %IW0    : INT;
  Full  AT %IX10.0 : BOOL;
  Speed AT %IW2    : INT;
  Valve AT %QX0.0  : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Full | COIL Valve |
RUNG
  | [ Level > Speed ] | COIL %QX1.0 |
END_PROGRAM
'''
MAP = '''BOARD "plant"
BUS m    modbus-tcp host=127.0.0.1:9
BUS yard peer interface=lo
%IW0     modbus bus=m unit=1 input-register=0 stale=600s substitute=77
%IX10.0  modbus bus=m unit=1 discrete-input=0 stale=600s
%IW20..26 modbus bus=m unit=2 input-register=8 stale=600s
%IW2     peer   from=far name=Speed stale=400ms
%QX0.0   modbus bus=m unit=1 coil=0 safe=0
%QX1.0   sim safe=0
'''
LEVEL, FULL, VALVE = 0, 1, 7


def fact(editor, name, text):
    """A line of the page with the state of the board."""
    until(lambda: [node for node in editor.all(name, 'label') if text in node.text()], '%s: %s' % (name, text))


def quality(screen):
    """the panel, the table and the state of the board mark a value that is stale or in fault"""
    board = Board(screen, 'plant', program=PROGRAM, board=MAP, role='eng io')
    for name, text in ('plant.rung', PROGRAM), ('plant.io', MAP):
        with open(os.path.join(screen.home, name), 'w') as out:
            out.write(text)
    gateway = client.as_gateway(board.folder + '/link', 'modbus')
    gateway.io_put((LEVEL, client.INT, 1200), (FULL, client.BOOL, True), (VALVE, client.BOOL, True))
    editor = Editor(screen, os.path.join(screen.home, 'plant.rung'))
    editor.to_sheet()
    connect(editor, board.where)
    says(editor, 'plant · RUN')
    editor.find('Speed, %IW2, stale')
    assert not editor.all('Level, %IW0, stale') and not editor.all('Full, %IX10.0, stale')
    for _ in range(3):
        gateway.io_put((FULL, client.BOOL, None))
    editor.find('Full, %IX10.0, on, fault')
    editor.shot('field-panel')
    open_map(editor)
    editor.tab('Modbus and modules (4)')
    editor.find('%IW0, Value: 1200', 'push button')
    editor.find('%IX10.0, Value: 1, fault', 'push button')
    editor.find('%IW20..26, Value: 0 0 0 0, stale', 'push button')
    editor.shot('field-table')
    gateway.io_put((FULL, client.BOOL, False), (LEVEL, client.INT, 1300))
    editor.find('%IW0, Value: 1300', 'push button')
    until(lambda: not editor.all('%IX10.0, Value: 0, fault'), 'the input to be good')
    editor.find('%IX10.0, Value: 0', 'push button')
    editor.tab('Other boards (1)')
    editor.find('%IW2, Value: 0, stale', 'push button')
    editor.command('State of the board')
    fact(editor, 'Values of the I/O map', '3 good, 5 stale, 0 in fault')
    fact(editor, 'Values that are not good', '%IW2 ⚠ stale')
    fact(editor, 'Gateway modbus', 'points: 7')
    editor.shot('field-state')
    gateway.close()
    fact(editor, 'Values of the I/O map', '0 good, 8 stale, 0 in fault')
    fact(editor, 'Gateway modbus', 'points: 7, the program is not there')
    board.stop()


THERE = MAP.replace('%QX1.0   sim', '%QX1.0   gpio line=OUT0')
HERE = '''BOARD "plant"
%IX10.0 gpio line=IN0 pull-up
%IX10.1 gpio line=NOWHERE
%QX0.0  gpio chip=panel offset=3 safe=0
%QX1.0  gpio line=OUT0 safe=0
%IW0    w1   sensor=28-2
%IW2    sim
'''


def there(screen):
    """lines and devices of the connected board are offered and named; without it those of this machine again"""
    sys_, dev = os.path.join(screen.home, 'sys'), os.path.join(screen.home, 'dev')
    for name, text in [(dev + '/gpiochip0', ''), (sys_ + '/bus/w1/devices/28-1/temperature', '21437\n')]:
        os.makedirs(os.path.dirname(name))
        with open(name, 'w') as out:
            out.write(text)
    board = Board(screen, 'plant', program=PROGRAM, board=THERE, role='eng', daemon='tests/hal/ladderd_v2',
                  env={'FAKE_DEV': dev, 'FAKE_SYS': sys_})
    for name, text in ('plant.rung', PROGRAM), ('plant.io', HERE):
        with open(os.path.join(screen.home, name), 'w') as out:
            out.write(text)
    editor = Editor(screen, os.path.join(screen.home, 'plant.rung'))
    editor.to_sheet()
    open_map(editor)
    editor.find('This machine has no GPIO lines.')
    connect(editor, board.where)
    says(editor, 'plant · RUN')
    for name, text in [('%IX10.0', 'gpiochip0 0'), ('%IX10.1', '"NOWHERE": the connected board has no such line'),
                       ('%QX0.0', 'gpiochip0 3'), ('%QX1.0', 'gpiochip0 2')]:
        row_says(editor, name + ', gpio', text)
    editor.click(editor.find('%IX10.1, I/O line', 'text'))
    editor.keys('alt+Down')
    editor.find('IN1 gpiochip0 (panel) 1, free', 'list item')
    editor.shot('field-lines')
    editor.keys('Escape')
    editor.tab('Analog (2)')
    editor.click(editor.find('%IW0, Device', 'text'))
    editor.keys('alt+Down')
    editor.find('28-1', 'list item')
    editor.find('21.437 °C', 'list item')
    editor.shot('field-devices')
    editor.keys('Down', 'Return')
    until(lambda: editor.find('%IW0, Device', 'text').text() == '28-1', 'the sensor of the board')
    editor.click(editor.find('Disconnect', 'push button'))
    editor.find('This machine has no GPIO lines.')
    board.stop()


class OldBoard:
    """Between a desk and a board: the board knows no service 42, as ladderd before the lists of devices. `busy`: it knows
    it, and is still looking."""

    def __init__(self, board):
        self.path, self.where = board.folder + '/link', 'unix:%s/old' % board.folder
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(board.folder + '/old')
        self.listener.listen()
        self.asked, self.busy = 0, False
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            desk, board = self.listener.accept()[0], socket.socket(socket.AF_UNIX)
            board.connect(self.path)
            threading.Thread(target=self.pass_on, args=(desk, board, client.DEVICES, 250), daemon=True).start()
            threading.Thread(target=self.pass_on, args=(board, desk, 250, client.DEVICES), daemon=True).start()

    def pass_on(self, source, target, what, other):
        """Frames of the service `what` become those of `other`."""
        data = b''
        while more := source.recv(65536):
            data += more
            while len(data) >= 4 and len(data) >= 4 + (size := struct.unpack('<I', data[:4])[0]):
                service = data[4]
                if self.busy and service == client.DEVICES:
                    data = data[:8] + bytes([0 if other == client.DEVICES else data[8]]) + data[9:]
                elif service == what:
                    self.asked, service = self.asked + (what == client.DEVICES), other
                target.sendall(data[:4] + bytes([service]) + data[5:4 + size])
                data = data[4 + size:]
        target.close()


def older(screen):
    """a board that does not know the list of devices: the table says so once, offers what this machine has, and works"""
    board = Board(screen, 'plant', program=PROGRAM, board=MAP, role='eng')
    old = OldBoard(board)
    for name, text in ('plant.rung', PROGRAM), ('plant.io', MAP):
        with open(os.path.join(screen.home, name), 'w') as out:
            out.write(text)
    editor = Editor(screen, os.path.join(screen.home, 'plant.rung'))
    editor.to_sheet()
    open_map(editor)
    connect(editor, old.where)
    says(editor, 'plant · RUN')
    told = '“plant” does not tell its lines and devices (this board is too old or too small for that).'
    says(editor, told)
    editor.shot('field-older')
    editor.tab('Modbus and modules (4)')
    says(editor, told)
    editor.find('%IW0, Value: 77, stale', 'push button')
    editor.tab('Pins (1)')
    editor.find('%QX1.0, Value: 1', 'push button')
    assert old.asked == 1, old.asked
    press(editor, 'Stop')
    editor.find('Stop the program on “plant”?', 'label')
    editor.keys('Return')
    says(editor, 'plant · STOP')
    assert old.asked == 1, old.asked
    editor.click(editor.find('Disconnect', 'push button'))
    until(lambda: not [node for node in editor.all(told, 'label') if told in node.name], 'the message to go')
    connect(editor, board.where)
    says(editor, 'plant · STOP')
    says(editor, 'Lines and devices to choose from are those of “plant”.')
    board.stop()


def slow(screen):
    """a board that looks again: what it did not tell before is no longer said; one that never ends is still looking"""
    board = Board(screen, 'plant', program=PROGRAM, board=MAP, role='eng')
    old = OldBoard(board)
    for name, text in ('plant.rung', PROGRAM), ('plant.io', MAP):
        with open(os.path.join(screen.home, name), 'w') as out:
            out.write(text)
    editor = Editor(screen, os.path.join(screen.home, 'plant.rung'))
    editor.to_sheet()
    open_map(editor)
    connect(editor, old.where)
    says(editor, 'plant · RUN')
    told = '“plant” does not tell its lines and devices'
    says(editor, told + ' (this board is too old or too small for that).')
    old.busy = True
    editor.click(editor.find('Refresh lines and devices', 'push button'))
    until(lambda: not [node for node in editor.all(told, 'label') if told in node.name], 'the message to go', 40)
    until(lambda: editor.all(told + ' (it is still looking).', 'label'), 'the board to be given up', 120)
    editor.shot('field-still')
    board.stop()


if __name__ == "__main__":
    main([quality, there, older, slow])
