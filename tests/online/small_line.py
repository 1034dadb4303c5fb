#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""small_line - tests `make SMALL=1 LINK=serial` from outside: a ladderd without names and without a thread at the end of
a serial line, and the client made from docs/online.md or `ladder board` at the other.
"""
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import BOOL, INT, STRING, Gone  # noqa: E402
from link import Board, refused  # noqa: E402
from serial_line import Cable, Faults, ladder, line, read_over_a_cut  # noqa: E402

ROUNDS = int(os.environ.get('SERIAL_ROUNDS', '200'))
WORD = 3
PUMP = '''RUNGBOARD 1
PROJECT "Pump"

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
  Count AT %MW0 : WORD;
  Label : STRING := 'hello';
  Level : INT := 12;
  Slow : TON;
END_VAR
VAR CONSTANT
  Most : INT := 7;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start  | NC Brake | COIL Motor |
  | NO Motor^ |
RUNG
  | NO Motor | TON Slow PT:=T#2s |
RUNG
  | NO Start | ADD IN1:=Level IN2:=Most OUT=>Level |
END_PROGRAM
'''
OTHER = PUMP.replace('Level : INT := 12', 'Level : INT := 13')
MAP = 'BOARD "in a field"\n%IX0.0 sim\n%QX0.0 sim\n%QX0.1 sim safe=1\n'


class SmallBoard:
    """A small ladderd at one end of a cable. It runs images only."""

    def __init__(self, cable, *options, baud=921600):
        self.folder = tempfile.mkdtemp()
        # A busy machine makes scans late, which must not end in FAULT.
        self.arguments = ['pump.rungc', '--io', 'board.io', '--serial', f'{cable.board},{baud}', '--trace-io',
                          '--watchdog', '1000', *options]
        self.image('pump', PUMP)
        self.write('board.io', MAP)
        self.start()

    def write(self, name, text):
        with open(f'{self.folder}/{name}', 'w', encoding='utf-8') as out:
            out.write(text)

    def read(self, name):
        with open(f'{self.folder}/{name}', encoding='utf-8') as file:
            return file.read()

    def image(self, name, text, *options):
        self.write(f'{name}.rung', text)
        subprocess.run([link.BUILD + '/ladder', 'build', *options, f'{name}.rung', '-o', f'{name}.rungc'],
                       cwd=self.folder, check=True, timeout=60, stderr=subprocess.DEVNULL)

    def start(self):
        with open(self.folder + '/err', 'w', encoding='utf-8') as err:
            self.daemon = subprocess.Popen([link.BUILD + '/small-serial/ladderd', *self.arguments], cwd=self.folder,
                                           stdout=subprocess.DEVNULL, stderr=err, stdin=subprocess.DEVNULL)

    def stop(self):
        if self.daemon.poll() is None:
            self.daemon.send_signal(signal.SIGTERM)
        return self.daemon.wait(60)

    def parts(self, name):
        with open(f'{self.folder}/{name}.rungc', 'rb') as file:
            return [file.read(), MAP.encode(), b'\0\0']

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.stop()
        shutil.rmtree(self.folder)


def places():
    """Program and places of the variables of PUMP, as a ladderd tells them that has names."""
    with Board(PUMP, board=MAP) as board:
        desk = board.client()
        return desk.status()['program'], {name: row[2] for name, row in desk.symbols().items()}


def test_values_by_reference():
    program, place = places()
    with Cable() as cable, SmallBoard(cable) as board:
        desk = line(cable)
        assert desk.role == 3 and desk.board == 'in a field', (desk.role, desk.board)
        status = desk.status()
        assert status['mode'] == client.RUN and status['program'] == program and status['sessions'] == 1, status
        assert status['points'] == 3, status
        while not desk.status()['up']:  # whole milliseconds
            pass
        label, level, most = place['Label'], place['Level'], place['Most']
        assert desk.read('%QX0.0', '%MW0', label, level, most) == [False, 0, b'hello', 12, 7]
        desk.write({'%MW0': (WORD, 500), label: (STRING, b'a pump'), level: (INT, -3)})
        assert desk.read('%MW0', label, level) == [500, b'a pump', -3]
        refused(8, lambda: desk.read('Level'), 'Level')
        refused(8, desk.symbols)
        refused(7, lambda: desk.read('%MW9999'), '%MW9999')
        refused(7, lambda: desk.read(0x07ffffff))
        refused(9, lambda: desk.write({'%MW0': (INT, 1)}), '%MW0')
        refused(10, lambda: desk.write({level: (INT, 5), most: (INT, 1)}))
        refused(6, lambda: desk.write({level: (INT, 5)}, mode=client.STOP))
        refused(6, lambda: desk.write({level: (INT, 5)}, program=bytes(32)))
        refused(11, lambda: desk.read(*[level] * 129))
        assert desk.read(level) == [-3]
        desk.stream.close()
        assert board.stop() == 0


def test_what_it_refuses():
    with Cable() as cable, SmallBoard(cable) as board:
        desk = line(cable)
        for service in (client.UPLOAD, client.EVENTS, client.CONFIG, client.RETAIN, client.PASSWORD, client.RECORD,
                        client.SUMS, client.PIECES, 99):
            refused(2, lambda it=service: desk.call(it, bytes(8)))
        refused(8, lambda: desk.publish_cells('Main'))
        refused(20, lambda: desk.begin(board.parts('pump')))
        assert desk.status()['mode'] == client.RUN
        desk.stream.close()
        for words, code in ((('record', '-o', 'act.record'), 'LD802'), (('get', 'Level'), 'LD808')):
            status, out, err = ladder(board, cable, *words)
            assert status != 0 and code in err and not out, (status, out, err)


def test_forces_hold_at_both_edges():
    with Cable() as cable, SmallBoard(cable) as board:
        desk = line(cable)
        desk.force({'%IX0.0': (BOOL, True), '%MW0': (WORD, 7)})
        assert desk.status()['forces'] == 2
        while desk.read('%QX0.0') != [True]:
            pass
        request, kinds = desk.publish(['%QX0.0', '%MW0'])
        number, fields = desk.next_told()
        assert number == request and client.take_values(fields, kinds)[4] == {0: (0, True), 1: (1, 7)}
        assert desk.forces() == {'%IX0.0': (True, False), '%MW0': (7, 0)}, desk.forces()
        refused(19, lambda: desk.unforce('%QX0.1'), '%QX0.1')
        desk.unforce()
        assert desk.status()['forces'] == 0 and desk.read('%QX0.0') == [True]
        desk.stream.close()
        assert ladder(board, cable, 'force', '%QX0.0=0')[0] == 0
        status, out, err = ladder(board, cable, 'get', '%QX0.0', '%MW0')
        assert status == 0 and '%QX0.0=0' in out and 'forced' in out and '%MW0=0' in out, (out, err)
        assert ladder(board, cable, 'unforce')[0] == 0
        status, out, err = ladder(board, cable, 'watch', '%QX0.0', '--count', '1')
        assert status == 0 and '%QX0.0=' in out, (out, err)


def test_messages_only_when_something_changes():
    with Cable() as cable, SmallBoard(cable):
        desk = line(cable)
        request, kinds = desk.publish(['%MW0'], 20000)
        seen = []
        for value in range(1, 6):
            desk.write({'%MW0': (WORD, value)})
            while not seen or seen[-1] != value:  # a message may only say that some are lost
                seen += [it for _quality, it in client.take_values(desk.next_told()[1], kinds)[4].values()]
        assert seen[-5:] == [1, 2, 3, 4, 5] and len(seen) <= 6, seen
        desk.call(client.UNPUBLISH, struct.pack('<H', request))
        desk.write({'%MW0': (WORD, 77)})
        assert desk.read('%MW0') == [77] and not desk.told
        refused(11, lambda: desk.publish(['%MW0'] * 129))


def test_stop_and_run():
    with Cable() as cable, SmallBoard(cable) as board:
        desk = line(cable)
        desk.force({'%IX0.0': (BOOL, True)})
        refused(15, lambda: desk.set_mode(1), 'RUN')
        desk.set_mode(0)
        assert desk.status()['mode'] == client.STOP
        while '%QX0.1 1' not in board.read('err'):  # its safe value
            time.sleep(0.01)
        desk.set_mode(1)
        status = desk.status()
        assert status['mode'] == client.RUN and status['forces'] == 0, status
        desk.stream.close()
        assert ladder(board, cable, 'stop')[0] == 0
        assert ladder(board, cable, 'run')[0] == 0
        status, out, err = ladder(board, cable, 'status')
        assert status == 0 and 'RUN' in out, (out, err)


def test_scans_go_on_while_a_desk_asks():
    with Cable() as cable, SmallBoard(cable, '--period', '100ms'):
        desk = line(cable)
        desk.publish(['%MW0'])
        before = desk.status()
        for i in range(ROUNDS):
            desk.write({'%MW0': (WORD, i)})
            assert desk.read('%MW0') == [i]
        after = desk.status()
        scans, missed = (after[it] - before[it] for it in ('scans', 'missed'))
        assert missed < scans, (scans, missed)


def test_a_download():
    with Cable() as cable, SmallBoard(cable, '--slots', '.') as board:
        board.image('other', OTHER)
        desk = line(cable)
        old, parts = desk.status()['program'], board.parts('other')
        data = b''.join(parts)
        refused(15, lambda: desk.begin(parts), 'RUN')
        desk.set_mode(0)
        refused(21, lambda: desk.call(client.VERIFY))
        assert desk.begin(parts) == 0
        refused(22, lambda: desk.call(client.BLOCK, struct.pack('<I', 5) + data[5:9]))
        desk.send_from(data[:500], 0)
        refused(22, lambda: desk.call(client.VERIFY))
        damaged = bytearray(data)
        damaged[300] ^= 4
        assert desk.begin(parts) == 0
        desk.send_from(bytes(damaged), 0)
        refused(22, lambda: desk.call(client.VERIFY))
        for bad, code in (([bytes(500), MAP.encode(), b''], 'LD6'),
                          ([parts[0], b'BOARD "x"\n%QX0.0 nothing\n', b''], 'LD5')):
            desk.send_from(b''.join(bad), desk.begin(bad))
            try:
                desk.verify()
                raise AssertionError('verified')
            except client.Refused as error:
                assert error.number == 23 and code in error.parts[0], error
        refused(21, lambda: desk.commit(1))
        desk.send_from(data, desk.begin(parts))
        same, new, count, _losses = desk.verify()
        assert same == 0 and new != old and count == 0
        refused(2, lambda: desk.commit(0))
        refused(6, lambda: desk.commit(1, program=new))
        assert desk.status()['program'] == old and not os.path.exists(board.folder + '/prog.A')
        desk.commit(2)
        desk.stream.close()
        desk = line(cable)
        status = desk.status()
        assert status['program'] == new and status['mode'] == client.STOP, status
        desk.set_mode(1)
        desk.stream.close()
        board.stop()
        board.start()
        assert line(cable).status()['program'] == new


def test_a_download_that_was_cut_goes_on():
    with Cable() as cable, SmallBoard(cable, '--slots', '.') as board:
        board.image('other', OTHER)
        parts = board.parts('other')
        desk = line(cable)
        desk.set_mode(0)
        desk.begin(parts)
        desk.send_from(b''.join(parts)[:500], 0)
        desk.stream.close(tell=False)
        desk = line(cable)
        refused(21, lambda: desk.call(client.VERIFY))
        assert desk.begin(parts) == 500
        desk.send_from(b''.join(parts), 500)
        desk.verify()
        desk.call(client.ABORT)
        refused(21, lambda: desk.commit(1))


def test_the_command_downloads():
    with Cable() as cable, SmallBoard(cable, '--slots', '.') as board:
        board.image('other', OTHER, '--small')
        line(cable).stream.close()  # the board has begun
        words = ('download', 'other.rungc', 'board.io', '--restart')
        status, out, err = ladder(board, cable, *words)
        assert status != 0 and 'LD815' in err and 'RUN' in err, (status, out, err)
        assert ladder(board, cable, 'stop')[0] == 0
        status, out, err = ladder(board, cable, *words)
        assert status == 0, (status, out, err)
        line(cable).stream.close()  # it has begun again
        status, out, err = ladder(board, cable, 'status')
        assert status == 0 and 'RUN' in out, (out, err)
        assert os.path.exists(board.folder + '/prog.A')


def test_a_program_that_is_too_large_or_has_words_that_it_does_not_know():
    with Cable() as cable, SmallBoard(cable, '--slots', '.') as board:
        desk = line(cable)
        desk.set_mode(0)
        refused(11, lambda: desk.begin([bytes(300000), b'', b'']))
        board.image('sine', PUMP.replace('ADD IN1:=Level IN2:=Most OUT=>Level', 'SIN IN:=Angle OUT=>Angle').replace(
            '  Slow : TON;', '  Slow : TON;\n  Angle : REAL;'))
        parts = board.parts('sine')
        desk.send_from(b''.join(parts), desk.begin(parts))
        refused(23, desk.verify)


def test_values_over_a_line_that_loses_doubles_changes_and_inserts():
    faults = Faults(5, lost=2, doubled=2, flipped=2, inserted=2)
    with Cable(faults) as cable, SmallBoard(cable):
        desk = line(cable)
        for i in range(ROUNDS):
            desk.write({'%MW0': (WORD, i)})
            assert desk.read('%MW0', '%QX0.1') == [i, False]
        assert faults.count > ROUNDS / 20 and desk.stream.sent_again > 0, faults.count


def test_a_download_over_a_bad_line():
    faults = Faults(6, lost=2, doubled=2, flipped=2, inserted=2)
    with Cable(faults) as cable, SmallBoard(cable, '--slots', '.') as board:
        board.image('other', OTHER)
        parts = board.parts('other')
        desk = line(cable)
        old = desk.status()['program']
        desk.set_mode(0)
        desk.send_from(b''.join(parts), desk.begin(parts))
        new = desk.verify()[1]
        try:
            desk.commit(1)
        except Gone:
            pass  # the answer was lost, and the board has begun again
        desk.stream.close()
        assert line(cable).status()['program'] == new != old


def test_junk_between_packets_and_in_frames():
    draw = random.Random(8)
    with Cable() as cable, SmallBoard(cable):
        desk = line(cable)
        for i in range(50):
            cable.insert(bytes(range(256)) + b'\x1b[0;32mstart\0' + os.urandom(700), to_board=True)
            desk.write({'%MW0': (WORD, i)})
            assert desk.read('%MW0') == [i]
        for service in range(256):
            for size in (0, 1, 40, 5000):
                for body in (bytes([255]) * size, draw.randbytes(size)):
                    try:
                        desk.call(service, body)
                    except client.Refused:
                        pass
        assert desk.read('%MW0') == [49]
        desk.stream.sendall(b'\xff\xff\xff\x7f' + bytes(8))
        refused(1, lambda: desk.answer(0))
        desk.stream.close()
        assert line(cable).read('%MW0') == [49]


def test_the_role_of_the_line():
    for role, may_reset in (('view', False), ('oper', True)):
        with Cable() as cable, SmallBoard(cable, '--serial-role', role):
            desk = line(cable)
            assert desk.read('%MW0') == [0]
            refused(17 if may_reset else 5, lambda it=desk: it.write({'%MW0': (WORD, 1)}))
            refused(5, lambda it=desk: it.force({'%MW0': (WORD, 1)}))
            refused(5, lambda it=desk: it.set_mode(0))
            refused(15 if may_reset else 5, lambda it=desk: it.set_mode(3))


def test_a_cable_that_is_pulled_and_put_back():
    with Cable() as cable, SmallBoard(cable):
        desk = line(cable)
        desk.write({'%MW0': (WORD, 41)})
        assert read_over_a_cut(cable, desk, '%MW0') == [41]


def test_bad_wishes():
    with Cable() as cable, SmallBoard(cable) as board:
        assert line(cable).read('%MW0') == [0]
        for words, text in [(['--serial', cable.board], 'another program or window uses it'),
                            (['--serial', '/dev/null'], 'is no serial line'),
                            (['--serial', cable.desk, '--serial-role', 'boss'], 'is not view, oper or eng')]:
            done = subprocess.run([link.BUILD + '/small-serial/ladderd', 'pump.rungc', '--io', 'board.io', *words],
                                  cwd=board.folder, text=True, capture_output=True, timeout=60)
            assert done.returncode == 1 and text in done.stderr, (words, done.stderr)
        done = subprocess.run([link.BUILD + '/small-serial/ladderd', '--slots', '.', '--serial', cable.desk],
                              cwd=board.folder, text=True, capture_output=True, timeout=60)
        assert done.returncode == 2 and 'FILE is missing' in done.stderr, done.stderr


if __name__ == '__main__':
    link.PROGRAMS += ('small-serial/ladderd',)
    sys.exit(link.main(globals()))
