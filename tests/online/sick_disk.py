#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""sick_disk - ladderd as a whole on a disk that fails (tests/hal/disk_fake.c).

A board with retained values, a log, alarms, settings and two downloads is started again; then a value is written, a
setting is changed, a variable is forced and a program is downloaded, while the k-th call of the disk fails: once, or
this and all later ones. ladderd goes on, its scans and its outputs do not change, the trouble is told. On a good disk
everything that was acknowledged is there at the next start, and everything else is as it was.

DISK_STEP is how many calls lie between two that fail; 1: each call fails once. Without it a few do.
"""
import mmap
import os
import struct
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import BOOL, INT, Refused  # noqa: E402
from link import OTHER, SEAL, Board, build, until  # noqa: E402

STEP = int(os.environ.get('DISK_STEP', '0'))
KINDS = 'EIO', 'ENOSPC', 'half', 'EINTR'
EVER = 1 << 30
STORED = 'alarms', 'conf', 'ends', 'events', 'password', 'prog.A', 'prog.B', 'retain'
KEPT = SEAL.replace('VAR\n', 'VAR RETAIN\n  Kept : INT;\nEND_VAR\nVAR\n', 1)
OTHERS = [OTHER.replace('VAR\n', 'VAR RETAIN\n  Kept : INT;\nEND_VAR\nVAR\n', 1).replace('T#9s', f'T#{i}s')
          for i in (3, 4, 5)]


class SickBoard(Board):
    """A board, and the page that it shares with its disk."""

    ladderd = '/tests/hal/sick_ladderd'

    def __init__(self):
        with tempfile.NamedTemporaryFile(delete=False) as page:
            page.write(bytes(4096))
            page.flush()
            self.page = mmap.mmap(page.fileno(), 4096)
        os.environ['DISK_FAKE'] = page.name
        super().__init__(KEPT, '--slots', '.', '--retain', 'retain', '--retain-period', '10ms')

    def __exit__(self, *error):
        super().__exit__(*error)
        os.unlink(os.environ['DISK_FAKE'])

    def fail(self, at, times, kind):
        self.page[:20] = struct.pack('<5i', at, times, kind, 0, 0)

    def heal(self):
        self.page[:4] = bytes(4)

    def calls(self):
        return struct.unpack_from('<i', self.page, 12)[0]

    def failed(self):
        return struct.unpack_from('<i', self.page, 16)[0]

    def put(self, files):
        for name in os.listdir(self.folder):
            if name.startswith(STORED):
                os.unlink(f'{self.folder}/{name}')
        for name, data in files.items():
            with open(f'{self.folder}/{name}', 'wb') as out:
                out.write(data)

    def files(self):
        found = {}
        for name in STORED:
            if os.path.exists(f'{self.folder}/{name}'):
                with open(f'{self.folder}/{name}', 'rb') as stored:
                    found[name] = stored.read()
        return found

    def kill(self):
        self.daemon.kill()
        self.daemon.wait()


def attempt(do):
    """Whether it was done, and is kept; False, False: it was refused with a reason that names the disk."""
    try:
        do()
        return True, True
    except Refused as error:
        assert error.number in (25, 26, 32), error
        return error.number == 26, False  # 26: it runs, the next start begins with the one before


def goes_on(board, desk):
    """Scans and outputs are as on a good disk."""
    scans = desk.status()['scans']
    until(lambda: desk.status()['scans'] > scans + 2)
    assert board.daemon.poll() is None and desk.status()['mode'] == client.RUN
    assert desk.read('Motor', 'Brake') == [True, False]


def one(board, parts, good, orderly):
    """A life on the sick disk, and the next one on a good one. Returns whether anything failed."""
    board.start()
    desk = board.client()
    desk.force({'Start': (BOOL, True)})
    until(lambda: desk.read('Motor') == [True])
    began = desk.status()['program']
    assert began == good['program'] or board.failed(), 'the last good program runs'
    desk.write({'Kept': (INT, 77)})
    goes_on(board, desk)
    named, _kept = attempt(lambda: desk.set('name', 'new'))
    other = next(it for it in parts if it != began and it != good['program'])
    loaded, kept_on_disk = attempt(lambda: desk.download(parts[other]))
    status = desk.status()
    assert status['program'] == (other if loaded else began)
    goes_on(board, desk)
    if status['disk'] and board.failed() > 3:
        until(lambda: any(it['name'] == 'SYS_DISK_FAULT' for it in desk.alarms()[0]))
    told = status['disk'] or status['next'] or not named or not kept_on_disk
    before = board.failed()
    if orderly:
        assert board.stop() == 0
    else:
        board.kill()
    said = board.read('err')
    sick = board.failed()
    times, kind = struct.unpack_from('<2i', board.page, 4)
    fails = times == EVER and kind < 2  # a write that takes half goes on with the rest
    board.heal()
    assert not (before > 3 and fails) or told or 'not stored' in said or 'cannot' in said or 'damaged' in said, said
    board.start()
    desk = board.client()
    now = desk.status()
    runs = other if kept_on_disk and not status['next'] else good['program']
    assert now['mode'] == client.RUN and now['program'] == runs, (now['program'], runs, status['next_why'])
    assert now['program'] in parts and desk.upload() == parts[now['program']]
    kept = desk.read('Kept')[0]
    assert kept == 77 or (kept == 5 and (sick or not orderly)), kept
    if not sick:
        assert kept == 77 or not orderly
    name = desk.config()['name'][0]
    assert name == ('new' if named else 'old'), name
    ids = [(it['id'], it['args'][0]) for it in desk.events()]
    assert ids[:len(good['events'])] == good['events'] or sick, ids
    assert not any('damaged' in it['text'] for it in desk.alarms()[0]) or sick > 1
    board.kill()
    return sick


def lives(times):
    """Tries the kinds of failure, at calls spread over one life."""
    board = SickBoard()
    with board:
        programs = [build(board, f'p{i}.rung', text) for i, text in enumerate(OTHERS)]
        desk = board.client()
        parts = {}
        for it in programs:
            parts[desk.download(it)[1]] = it
        desk.write({'Kept': (INT, 5)})
        desk.set('name', 'old')
        desk.force({'Start': (BOOL, True)})
        until(lambda: any(it['name'] == 'SYS_FORCED_ANY' for it in desk.alarms()[0]))
        good = {'program': desk.status()['program'], 'events': None}
        assert board.stop() == 0
        board.start()
        desk = board.client()
        assert desk.read('Kept') == [5]
        board.stop()
        files = board.files()
        assert set(files) == set(STORED) - {'password'}, files.keys()
        board.fail(0, 0, 0)
        good['events'] = []
        one(board, parts, good, True)
        calls = board.calls()
        tries = failed = 0
        for kind, name in enumerate(KINDS):
            step = STEP or max(calls // 5, 1)
            for at in range(1 + (0 if STEP else (kind * 7) % step), calls + 1, step):
                if name == 'EINTR' and times == EVER:
                    break  # it would never end
                board.put(files)
                board.fail(at, times, kind)
                try:
                    failed += one(board, parts, good, tries % 2) > 0
                except Exception as error:
                    raise AssertionError(f'{name}, {times} times from call {at} of {calls} on: {error!r}\n' +
                                         board.read('err')) from error
                tries += 1
        print(f'# {tries} lives, in {failed} a call failed; {calls} calls in one')
        assert failed


def test_a_disk_that_fails_once():
    lives(1)


def test_a_disk_that_fails_for_ever():
    lives(EVER)


if __name__ == '__main__':
    link.PROGRAMS += ('tests/hal/sick_ladderd',)
    sys.exit(link.main(globals()))
