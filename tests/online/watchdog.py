#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""watchdog - scans that do not end in time: the outputs are safe, the board says FAULT once, and its link answers.

It prints how long that takes. WATCHDOGS is how often each is tried; with it, and with real-time priority, it fails where outputs
are safe later than 50 ms after the limit, or a status takes more than 200 ms.
"""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import BOOL, FAULT, RUN, Refused  # noqa: E402
from link import Board, until  # noqa: E402

TIMES = int(os.environ.get('WATCHDOGS', '0'))
PERIOD, PERIODS = 10, 5 if TIMES else 50
LIMIT = PERIOD * PERIODS / 1000
PROGRAM = '''RUNGBOARD 1
PROJECT "Watchdog"

VAR
  Go : BOOL;
  Count : DINT;
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main ST
VAR
  i : DINT;
END_VAR
  Motor := TRUE;
  Brake := FALSE;
  WHILE Go DO
    Count := Count + 1;
  END_WHILE;
END_PROGRAM
'''
SIM = 'BOARD "a panel"\n%QX0.0 sim safe=0\n%QX0.1 sim safe=1\n'
GPIO = 'BOARD "a panel"\n%IX0.0 gpio line=IN0\n%QX0.0 gpio line=OUT0 safe=0\n%QX0.1 gpio line=OUT1 safe=1\n'
link.PROGRAMS += ('tests/hal/ladderd_uapi',)


class Driven(Board):
    """A ladderd whose lines are those of a driver that can hang."""
    ladderd = '/tests/hal/ladderd_uapi'

    def start(self, wait=True):
        os.makedirs(self.folder + '/dev', exist_ok=True)
        self.write('dev/gpiochip0', '')
        os.environ['FAKE_DEV'] = self.folder + '/dev'
        super().start(wait)


def last_levels(board):
    """The outputs as the trace of lines says."""
    levels = {}
    for line in board.read('err').splitlines():
        words = line.split()
        if len(words) == 2 and words[0].startswith('%QX'):
            levels[words[0]] = words[1]
    return levels


def is_safe(board):
    levels = last_levels(board)
    return levels.get('%QX0.0', '0') == '0' and levels.get('%QX0.1') == '1'


def runs(board):
    return last_levels(board) == {'%QX0.0': '1', '%QX0.1': '0'}


def soon(what):
    """As until(), and looks often: it returns when."""
    end = time.monotonic() + 60
    while not what():
        assert time.monotonic() < end
        time.sleep(0.0005)
    return time.monotonic()


class Figures:
    def __init__(self, what, decides):
        self.what, self.decides, self.safe, self.answers = what, decides, [], []

    def tell(self):
        safe, answers = max(self.safe) * 1000, max(self.answers) * 1000
        print(f'# {self.what}, {len(self.safe)} times: safe {safe:.0f} ms later at most, with a limit of {LIMIT * 1000:.0f} ms; '
              f'the longest answer took {answers:.1f} ms', flush=True)
        if self.decides:
            assert safe <= LIMIT * 1000 + 50 and answers <= 200, (safe, answers)


def options():
    rt = link.in_real_time()
    return bool(TIMES and rt), ['--period', f'{PERIOD}ms', '--watchdog', str(PERIODS), *(rt if TIMES else [])]


def asked(desk, figures):
    began = time.monotonic()
    status = desk.status()
    figures.answers.append(time.monotonic() - began)
    return status


def faults(desk):
    return sum(it['id'] == 3 for it in desk.events())


def watch(board, desk, figures):
    """The board says FAULT, with one event, and goes on doing so; the outputs are safe."""
    until(lambda: asked(desk, figures)['mode'] == FAULT)
    until(lambda: faults(desk) == 1)
    for _ in range(5):
        asked(desk, figures)
        time.sleep(PERIOD / 1000)
    assert faults(desk) == 1 and is_safe(board), (desk.events(), last_levels(board))


def test_a_loop_without_an_end():
    decides, given = options()
    figures = Figures('a loop without an end', decides)
    for _ in range(TIMES or 1):
        with Board(PROGRAM, *given, board=SIM) as board:
            desk, watcher = board.client(), board.client()
            until(lambda: runs(board))
            since = time.monotonic()
            desk.write({'Go': (BOOL, True)})
            figures.safe.append(soon(lambda: is_safe(board)) - since)
            watch(board, watcher, figures)
            desk.write({'Go': (BOOL, False)})
            board.daemon.send_signal(signal.SIGHUP)
            until(lambda: desk.status()['mode'] == RUN)
            until(lambda: runs(board))
    figures.tell()


test_a_loop_without_an_end.as_is = True


def test_a_driver_that_is_slow():
    """Each read takes longer than the limit."""
    decides, given = options()
    figures = Figures('a driver that is slow', decides)
    os.environ.update(FAKE_SLOW_AT='100', FAKE_SLOW_MS=str(int(1900 * LIMIT)))
    for _ in range(TIMES or 1):
        with Driven(PROGRAM, *given, board=GPIO) as board:
            desk = board.client()
            last_scan(board, desk, figures)
            watch(board, desk, figures)
    figures.tell()


test_a_driver_that_is_slow.as_is = True


def last_scan(board, desk, figures):
    """When the last scan ended before the first that does not: no other ends until the outputs are safe."""
    until(lambda: runs(board))
    scans = since = None
    while not is_safe(board):
        now = asked(desk, figures)['scans']
        if now != scans:
            scans, since = now, time.monotonic()
        time.sleep(0.0005)
    figures.safe.append(time.monotonic() - since)


def test_a_driver_that_hangs():
    """It never answers; a signal reaches it."""
    decides, given = options()
    figures = Figures('a driver that hangs', decides)
    os.environ['FAKE_HANG_AT'] = '100'
    for _ in range(TIMES or 1):
        with Driven(PROGRAM, *given, board=GPIO) as board:
            desk = board.client()
            last_scan(board, desk, figures)
            for _ in range(5):
                until(lambda: asked(desk, figures)['mode'] == FAULT)
                time.sleep(PERIOD / 1000)
            status = asked(desk, figures)
            assert is_safe(board) and status['fault'] == 'watchdog: a scan hangs and does not end', status
            try:
                desk.set_mode(RUN)
                raise AssertionError('a scan that hangs does no order')
            except Refused as refusal:
                assert refusal.number == 13, refusal
    figures.tell()


test_a_driver_that_hangs.as_is = True


if __name__ == '__main__':
    sys.exit(link.main(globals()))
