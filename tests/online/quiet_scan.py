#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""quiet_scan - what the scan thread does while desks watch it: its system calls, its page faults, and whether a
message ever holds values of two scans.

Short in `make check`. SCAN_SNAPSHOTS is the number of messages that the desks compare (1,000,000 for all of it),
SCAN_BOARDS the number of boards, each of which sends 400 a second to four desks, SCAN_CALLS the number of scans
whose system calls are counted.
"""
import contextlib
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from link import Board, Skip, until  # noqa: E402

SNAPSHOTS = int(os.environ.get('SCAN_SNAPSHOTS', '400'))
BOARDS = int(os.environ.get('SCAN_BOARDS', '1'))
CALLS = int(os.environ.get('SCAN_CALLS', '50'))
WORDS = 2048
ALL = list(range(WORDS))
NUMBERS = bytes(i & 255 for i in ALL), bytes(i >> 8 for i in ALL)
SAME = ('RUNGBOARD 1\nPROJECT "Same"\n\nVAR\n  Scans : DINT;\n' +
        ''.join(f'  N{i} : DINT;\n' for i in range(WORDS)) +
        'END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO SYS_ALWAYS_ON | ADD IN1:=Scans IN2:=1 OUT=>Scans |\n' +
        ''.join(f'RUNG\n  | [ N{i} := Scans ] |\n' for i in range(WORDS)) + 'END_PROGRAM\n')


class Desks:
    """Desks that watch all words as fast as the board sends, each in a thread of its own."""

    def __init__(self, board, count):
        self.over, self.seen, self.bad = False, [0] * count, []
        self.threads = [threading.Thread(target=self.watch, args=(board, i), daemon=True) for i in range(count)]
        for it in self.threads:
            it.start()

    def watch(self, board, number):
        try:
            self.look(board.client(), number)
        except Exception as error:  # pylint: disable=broad-except
            self.bad.append((number, self.seen[number], error))

    def look(self, desk, number):
        types = desk.publish([f'N{i}' for i in range(WORDS)])[1]
        assert set(types) == {client.DINT}
        last = offset = None
        while not self.over:
            data = desk.next_told()[1].rest()
            _kind, _mode, scan, _time, lost, count = struct.unpack_from('<BBQqIH', data)
            if lost and not count:
                continue  # it says only that messages were left out
            rows = data[struct.calcsize('<BBQqIH'):]
            if last is None:
                offset = scan - struct.unpack_from('<HBi', rows)[2]
            # Number, quality and value of each: byte by byte, for this is done a million times.
            value = struct.pack('<i', scan - offset)
            if count != WORDS or len(rows) != 7 * WORDS or (rows[::7], rows[1::7]) != NUMBERS or \
                    any(rows[3 + i::7] != value[i:i + 1] * WORDS for i in range(4)) or (last is not None and scan <= last):
                self.bad.append((scan, last, count, sorted({it[2] for it in struct.iter_unpack('<HBi', rows)})[:4]))
            last = scan
            self.seen[number] += 1

    def until(self, count):
        """Waits for so many messages, as long as it takes while each desk gets some."""
        while sum(self.seen) < count and not self.bad:
            before = list(self.seen)
            until(lambda: self.bad or sum(self.seen) >= count or all(map(int.__gt__, self.seen, before)))

    def end(self):
        self.over = True
        for it in self.threads:
            it.join()
        assert not self.bad, self.bad[:5]


def let_run(desk, desks, count):
    """Waits for so many scans, as long as it takes while they go on."""
    last = desk.status()['scans'] + count
    while not desks.bad and desk.status()['scans'] <= last:
        before = desk.status()['scans']
        until(lambda: desk.status()['scans'] > before)  # pylint: disable=cell-var-from-loop


def test_a_message_has_the_values_of_one_scan():
    with contextlib.ExitStack() as stack:
        all_desks = [Desks(stack.enter_context(Board(SAME, '--period', '2ms', '--watchdog', '1000')), 4) for _ in range(BOARDS)]
        for desks in all_desks:
            desks.until(-(-SNAPSHOTS // BOARDS))
        for desks in all_desks:
            desks.end()
        seen = sum(sum(desks.seen) for desks in all_desks)
        print(f'# {seen} messages of {WORDS} words, 4 desks at each of {BOARDS} boards: each of one scan, none older than the last')


def faults(pid):
    """Page faults of the scan thread, which is the first one: minor, major."""
    with open(f'/proc/{pid}/task/{pid}/stat', encoding='ascii') as file:
        fields = file.read().rsplit(')', 1)[1].split()
    return int(fields[7]), int(fields[9])


def test_a_scan_meets_no_page_fault():
    """Also without locked memory, and when what desks write fills the record: 2,048 values are some pages of it."""
    link.not_by_tsan('its own memory and calls')
    rt = link.in_real_time()
    for options in [[], rt] if rt else [[]]:
        with Board(SAME, '--period', '5ms', *options) as board:
            desks = Desks(board, 2)
            desk = board.client()
            values = {f'N{i}': (client.DINT, 7) for i in ALL}
            desk.write(values)
            until(lambda: desks.bad or min(desks.seen) > 20)
            warm = faults(board.daemon.pid)
            for _ in range(4):
                desk.write(values)
            let_run(desk, desks, 4 * CALLS)
            now = faults(board.daemon.pid)
            desks.end()
            assert now == warm, (options, warm, now)
    print(f'# {4 * CALLS} scans, 2 desks, 4 x {WORDS} values written: no page fault of the scan thread')


test_a_scan_meets_no_page_fault.as_is = True


def test_a_scan_calls_nothing_but_its_sleep():
    link.not_by_tsan('its own memory and calls')
    if not shutil.which('strace'):
        raise Skip('needs strace')
    with Board(SAME, '--period', '5ms') as board, tempfile.NamedTemporaryFile('r') as out:
        desks = Desks(board, 2)
        desk = board.client()
        until(lambda: min(desks.seen) > 3)
        with subprocess.Popen(['strace', '-o', out.name, '-p', str(board.daemon.pid)], stderr=subprocess.DEVNULL) as trace:
            until(lambda: trace.poll() is not None or os.path.getsize(out.name))
            if trace.poll() is not None:
                desks.end()
                raise Skip('this user may not trace')
            let_run(desk, desks, CALLS)
            trace.send_signal(signal.SIGINT)
        desks.end()
        text = out.read()
    # A signal ends the sleep when a desk has an order.
    called = dict.fromkeys(re.findall(r'^(\w+)\(', text, re.M), 0)
    for name in called:
        called[name] = len(re.findall(rf'^{name}\(', text, re.M))
    assert set(called) <= {'clock_nanosleep', 'rt_sigreturn', 'restart_syscall'} and called['clock_nanosleep'] > CALLS, called
    print(f'# {called}')


if __name__ == '__main__':
    sys.exit(link.main(globals()))
