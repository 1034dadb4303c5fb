#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""serial_line - tests the serial line of ladderd from outside: two terminals, and between them a line that loses,
doubles, changes, delays and inserts bytes. A value is right, or the failure is clear.

The client is made from docs/online.md. SERIAL_ROUNDS sets how many values go over the bad line.
"""
import os
import pty
import random
import select
import signal
import subprocess
import sys
import threading
import time
import tty

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import INT, Client, Gone, Line  # noqa: E402
from link import MAP, SEAL, Board, refused  # noqa: E402

ROUNDS = int(os.environ.get('SERIAL_ROUNDS', '400'))


class Cable:
    """Two terminals and a thread that carries bytes between them. `fault(bytes)` is what becomes of bytes that go
    from one to the other; `speed` bytes a second, if it is set."""

    def __init__(self, fault=None, speed=None):
        self.fault, self.speed, self.cut, self.over = fault, speed, False, False
        self.ends = [pty.openpty() for _ in range(2)]
        for _master, slave in self.ends:
            tty.setraw(slave)
        self.desk, self.board = (os.ttyname(slave) for _master, slave in self.ends)
        self.thread = threading.Thread(target=self.carry, daemon=True)
        self.thread.start()

    def carry(self):
        masters = [master for master, _slave in self.ends]
        while not self.over:
            for master in select.select(masters, [], [], 0.05)[0]:
                data = os.read(master, 64)
                other = masters[1 - masters.index(master)]
                if self.cut:
                    continue
                if self.speed:
                    time.sleep(len(data) / self.speed)
                if self.fault:
                    data = self.fault(data)
                if data:
                    os.write(other, data)

    def insert(self, data, to_board=False):
        os.write(self.ends[1 if to_board else 0][0], data)

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.over = True
        self.thread.join()
        for end in self.ends:
            for fd in end:
                os.close(fd)


class Faults:
    """Of 10,000 bytes, so many are lost, doubled, changed, or have a byte before them that nobody sent."""

    def __init__(self, seed, lost=0, doubled=0, flipped=0, inserted=0, late=0):
        self.random = random.Random(seed)
        self.kinds = (lost, doubled, flipped, inserted, late)
        self.count = 0

    def __call__(self, data):
        out = bytearray()
        for byte in data:
            lost, doubled, flipped, inserted, late = (self.random.random() * 10000 < it for it in self.kinds)
            self.count += lost + doubled + flipped + inserted + late
            if inserted:
                out.append(self.random.randrange(256))
            if late:
                time.sleep(0.15)
            if lost:
                continue
            out.append(byte ^ (1 << self.random.randrange(8)) if flipped else byte)
            if doubled:
                out.append(byte)
        return bytes(out)


class SerialBoard(Board):
    """A ladderd at one end of a cable; its socket only says when it has begun."""

    def __init__(self, cable, *options, baud=921600, **more):
        super().__init__(SEAL, '--serial', f'{cable.board},{baud}', *options, **more)


def line(cable, **options):
    return Client(Line(cable.desk, **options))


def ladder(board, cable, *words, baud=921600):
    done = subprocess.run([link.BUILD + '/ladder', 'board', f'serial:{cable.desk},{baud}', *words], cwd=board.folder,
                          text=True, capture_output=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def test_a_client_made_from_the_page():
    with Cable() as cable, SerialBoard(cable, '--slots', '.') as board:
        desk = line(cable)
        assert desk.role == 3 and desk.board == 'on a table', (desk.role, desk.board)
        assert desk.status()['mode'] == client.RUN and 'Slow.ET' in desk.symbols()
        desk.write({'Count': (INT, 5)})
        assert desk.read('Count', 'Label') == [5, b'hello']
        desk.force({'Start': (client.BOOL, True)})
        request, kinds = desk.publish(['Motor'])
        number, fields = desk.next_told()
        assert number == request and client.take_values(fields, kinds)[4] == {0: (0, True)}
        parts = desk.upload()
        assert parts[0]
        desk.download(parts)
        assert desk.status()['mode'] == client.RUN
        events = desk.events()
        assert {'serial'} == {it['user'] for it in events if it['role'] == 3}
        desk.stream.close()
        assert board.stop() == 0


def values_go(cable, faults):
    desk = line(cable)
    for i in range(ROUNDS):
        desk.write({'Count': (INT, i)})
        assert desk.read('Count', 'Most') == [i, 7]
    assert faults.count > ROUNDS / 20, faults.count
    return desk


def test_values_over_a_line_that_loses_doubles_changes_and_inserts():
    faults = Faults(1, lost=2, doubled=2, flipped=2, inserted=2)
    with Cable(faults) as cable, SerialBoard(cable):
        desk = values_go(cable, faults)
        assert desk.stream.sent_again > 0


def test_values_over_a_line_that_stops_now_and_then():
    faults = Faults(2, late=6)
    with Cable(faults) as cable, SerialBoard(cable):
        desk = values_go(cable, faults)
        # A piece that comes late is sent again; its number says that it was taken already.
        assert desk.stream.sent_again > 0 and desk.read('Count') == [ROUNDS - 1]


def test_the_command_over_a_bad_line():
    faults = Faults(3, lost=3, doubled=3, flipped=3, inserted=3)
    with Cable(faults) as cable, SerialBoard(cable) as board:
        for i in range(20):
            assert ladder(board, cable, 'set', f'Count={i}') == (0, '', '')
            assert ladder(board, cable, 'get', 'Count', 'Label') == (0, f"Count={i}\nLabel='hello'\n", '')
        status, out, err = ladder(board, cable, 'watch', 'Motor', '--count', '1')
        assert status == 0 and 'Motor=0' in out, (out, err)
        assert faults.count


def test_a_download_over_a_bad_line():
    faults = Faults(4, lost=2, doubled=2, flipped=2, inserted=2)
    with Cable(faults) as cable, SerialBoard(cable, '--slots', '.') as board:
        desk = line(cable)
        before = desk.status()['program']
        board.write('other.rung', SEAL.replace('Most : INT := 7', 'Most : INT := 8'))
        desk.stream.close()
        status, out, err = ladder(board, cable, 'download', 'other.rung', 'board.io', '--yes')
        assert status == 0, (out, err)
        desk = line(cable)
        assert desk.read('Most') == [8] and desk.status()['program'] != before


def test_nobody_answers():
    with Cable() as cable, SerialBoard(cable) as board:
        cable.cut = True
        status, out, err = ladder(board, cable, 'status')
        assert status == 2 and 'LD855' in err and '--serial' in err and not out, err


def test_a_login_answers_or_the_speed_is_wrong():
    # A board that hears another speed does not answer; a login answers with text.
    for fault, code in ((lambda data: bytes(byte ^ 0x55 for byte in data), 'LD855'),
                        (lambda data: b'\r\ngarage login: ', None)):
        with Cable(fault) as cable, SerialBoard(cable) as board:
            answers = threading.Timer(0.5, lambda it=cable: it.insert(b'\r\ngarage login: '))
            if not code:
                answers.start()
            status, out, err = ladder(board, cable, 'status', baud=9600)
            answers.cancel()
            assert status == 2 and (code or 'LD856') in err and '9600 baud' in err and not out, err


def test_lines_of_a_kernel_are_ignored():
    with Cable() as cable, SerialBoard(cable):
        desk = line(cable)
        for i in range(50):
            cable.insert(b'[   12.345678] usb 1-1: new high-speed USB device number 4\r\n')
            cable.insert(b'\x1b[0;32mstart\0' if i % 2 else b'root\r\n', to_board=True)
            desk.write({'Count': (INT, i)})
            assert desk.read('Count') == [i]


def read_over_a_cut(cable, desk, name):
    """The values that come when a cable is put back: it was pulled until the request had been sent again."""
    found = []
    cable.cut = True
    waits = threading.Thread(target=lambda: found.extend(desk.read(name)))
    waits.start()
    while desk.stream.sent_again < 3:
        time.sleep(0.01)
    cable.cut = False
    waits.join()
    return found


def test_a_cable_that_is_pulled_and_put_back():
    with Cable() as cable, SerialBoard(cable):
        desk = line(cable)
        desk.write({'Count': (INT, 41)})
        assert read_over_a_cut(cable, desk, 'Count') == [41]


def test_a_desk_that_begins_anew():
    with Cable() as cable, SerialBoard(cable) as board:
        first = line(cable)
        first.force({'Start': (client.BOOL, True)})
        first.publish(['Motor', 'Count'])
        first.stream.close(tell=False)
        second = line(cable)
        assert second.status()['forces'] == 1 and second.read('Start') == [True]
        assert board.client().status()['sessions'] == 2


def test_a_board_that_begins_anew():
    with Cable() as cable, SerialBoard(cable) as board:
        desk = line(cable, limit=20)
        board.daemon.kill()
        board.daemon.wait()
        board.start()
        try:
            desk.read('Count')
            raise AssertionError('the session goes on')
        except Gone:
            assert desk.stream.over
        desk.stream.close()
        assert line(cable).read('Label') == [b'hello']


def test_the_role_of_the_line():
    with Cable() as cable, SerialBoard(cable, '--serial-role', 'view'):
        desk = line(cable)
        assert desk.role == 1 and desk.read('Most') == [7]
        refused(5, lambda: desk.write({'Count': (INT, 1)}), 'write', 'oper', 'view')


def test_a_slow_line_loses_messages_and_counts_them():
    with Cable(speed=1200) as cable, SerialBoard(cable, baud=9600):
        desk = line(cable)
        desk.force({'Start': (client.BOOL, True)})
        _request, kinds = desk.publish(['Count', 'Slow.ET', 'Motor'])
        lost, last = 0, 0
        while lost < 3:
            _number, fields = desk.next_told()
            _mode, scan, _time, missed, _changed = client.take_values(fields, kinds)
            assert scan > last
            lost, last = lost + missed, scan


def test_two_desks_at_one_line_and_other_bad_wishes():
    with Cable() as cable, SerialBoard(cable) as board:
        for words, text in [(['--serial', cable.board], 'another program or window uses it'),
                            (['--serial', cable.desk + ',123'], 'is no speed of a serial line'),
                            (['--serial', '/dev/null'], 'is no serial line'),
                            (['--serial', '/dev/ttyNone9'], 'No such file'),
                            (['--serial', cable.desk, '--serial-role', 'boss'], 'is not view, oper or eng')]:
            done = subprocess.run([link.BUILD + '/ladderd', 'program.rung', '--io', 'board.io', *words],
                                  cwd=board.folder, text=True, capture_output=True, timeout=60)
            assert done.returncode == 1 and text in done.stderr, (words, done.stderr)
        done = subprocess.run([link.BUILD + '/ladder', 'board', f'serial:{cable.board}', 'status'], text=True,
                              capture_output=True, timeout=60)
        assert done.returncode == 2 and 'LD011' in done.stderr, done.stderr


def test_a_board_with_a_serial_line_alone():
    with Cable() as cable, SerialBoard(cable) as board:
        board.stop()
        os.makedirs(board.folder + '/empty')
        board.write('other.io', MAP)
        daemon = subprocess.Popen([link.BUILD + '/ladderd', '--slots', 'empty', '--serial', cable.board],
                                  cwd=board.folder, stderr=subprocess.DEVNULL)
        try:
            desk = line(cable)
            assert desk.status()['mode'] == client.STOP
            desk.stream.close()
            status, out, err = ladder(board, cable, 'download', 'program.rung', 'other.io', '--yes', '--restart',
                                      baud=115200)
            assert status == 0, (out, err)
            desk = line(cable)
            assert desk.read('Label') == [b'hello']
        finally:
            daemon.send_signal(signal.SIGTERM)
            assert daemon.wait(60) == 0


if __name__ == '__main__':
    sys.exit(link.main(globals()))
