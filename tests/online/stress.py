#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""stress - many desks at once, and desks and boards in trouble: the board goes on, and each loser is told why.

Short in `make check`. LINK_STRESS=1 runs all of it: 3 sessions with 1,000 changes each, 500 random projects, 1,000
connects beside 10,000 frames of junk a second. JITTER=60 (seconds) measures how late scans begin while eight desks watch
and all processors are busy (`make bench-jitter`): with `stress-ng`, or with endless loops where that is not installed. It
fails if this user may have real-time priority. JITTER_WITHOUT_RT=1 runs the board without one, to see it fail.
"""
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time
from itertools import permutations

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import ANY, BOOL, INT, STRING, Client, Gone, Refused  # noqa: E402
from link import OTHER, SEAL, Board, attempt, build, refused, slots, until  # noqa: E402

LONG = 'LINK_STRESS' in os.environ
JITTER = int(os.environ.get('JITTER', '0'))
WITHOUT_RT = 'JITTER_WITHOUT_RT' in os.environ


def tell(text):
    print('# ' + text, flush=True)


# ---- three desks, one board ----

def after(state, change):
    """What the board answers to @change in @state, and its state then. A state: mode, program, values, force."""
    mode, program, values, force = state
    kind, expect_mode, expect_program, it = change
    if expect_mode not in (ANY, mode) or expect_program != program:
        return 6, state
    if kind == 'write':
        return 0, (mode, program, (it, it + 1), force)
    if kind == 'force':
        return 0, (mode, program, values, it)
    if kind == 'commit':
        return 0, (mode, it, values, force)
    if (it == 0) != (mode == client.RUN):
        return 15, state
    return 0, (client.STOP, program, values, force) if it == 0 else (client.RUN, program, (1, 2), None)


def send(desk, change):
    kind, mode, program, it = change
    head = bytes([mode]) + program
    if kind == 'write':
        return desk.send(client.WRITE, head + struct.pack('<H', 2) + b''.join(
            client.ref(name) + bytes([INT]) + client.value(INT, number)
            for name, number in (('Table[1]', it), ('Table[2]', it + 1))))
    if kind == 'force' and it is None:
        return desk.send(client.UNFORCE, head + struct.pack('<H', 0))
    if kind == 'force':
        return desk.send(client.FORCE, head + struct.pack('<H', 1) + client.ref('Table[4]') + bytes([INT]) +
                         client.value(INT, it))
    if kind == 'commit':
        return desk.send(client.COMMIT, head + b'\0')
    return desk.send(client.MODE, head + bytes([it]))


def look(desk):
    status = desk.status()
    values = desk.read('Table[1]', 'Table[2]', 'Table[4]')
    return status['mode'], status['program'], tuple(values[:2]), values[2] if desk.forces() else None


def test_three_desks_change_one_board():
    """In each round three requests are under way at once; some order of them explains all answers and the state."""
    draw = random.Random(21)
    rounds = 1000 if LONG else 60
    with slots() as board:
        parts, programs = {}, []
        desk = board.client()
        for number in (3, 4):
            made = build(board, f'p{number}.rung', OTHER.replace('T#9s', f'T#{number}s'))
            programs.append(desk.download(made)[1])
            parts[programs[-1]] = made
        desks = [board.client() for _ in range(3)]
        state = look(desk)
        known = [state] * 3
        conflicts = downloads = 0
        for turn in range(rounds):
            changes = []
            for number in range(3):
                if draw.random() < 0.7:
                    known[number] = state
                mode, program, _values, _force = known[number]
                mode = draw.choice([ANY, mode])
                kind = draw.choice(['write', 'write', 'force', 'mode', 'commit'])
                if kind == 'commit' and 'commit' in [it[0] for it in changes]:
                    kind = 'write'
                if kind == 'commit':
                    other = next(it for it in programs if it != state[1])
                    desks[number].send_from(b''.join(parts[other]), desks[number].begin(parts[other]))
                    desks[number].verify()
                    changes.append((kind, mode, program, other))
                elif kind == 'mode':
                    changes.append((kind, mode, program, draw.choice([0, 1, 1])))
                elif kind == 'force':
                    changes.append((kind, mode, program, draw.choice([None, draw.randrange(-500, 500)])))
                else:
                    changes.append((kind, mode, program, draw.randrange(30000)))
            sent = [send(it, change) for it, change in zip(desks, changes)]
            answers = []
            for it, number in zip(desks, sent):
                got = attempt(lambda: it.answer(number))  # pylint: disable=cell-var-from-loop
                answers.append(got.number if isinstance(got, Refused) else 0)
            now = look(desk)
            possible = []
            for order in permutations(range(3)):
                model, gives = state, [None] * 3
                for number in order:
                    gives[number], model = after(model, changes[number])
                possible.append((gives, model))
            assert (answers, now) in possible, (turn, state, changes, answers, now)
            for it, change, gave in zip(desks, changes, answers):
                if change[0] == 'commit' and gave:
                    attempt(lambda: it.call(client.ABORT))  # pylint: disable=cell-var-from-loop
                downloads += change[0] == 'commit' and not gave
                conflicts += gave == 6
            state = now
        assert conflicts > rounds / 10 and downloads > rounds / 20
        tell(f'{3 * rounds} changes of 3 desks: {conflicts} conflicts, {downloads} downloads')


def test_random_projects_come_back_as_they_went():
    count = 500 if LONG else 12
    with slots() as board:
        desk, done, seed = board.client(), 0, 0
        while done < count:
            seed += 1
            assert seed < 3 * count + 50
            subprocess.run([link.BUILD + '/tests/bin/ladder_random', str(seed), 'random'], cwd=board.folder, check=True,
                           stdout=subprocess.DEVNULL, **link.as_user(link.OWN))
            text = board.read('random.rung')
            try:
                parts = build(board, 'random.rung', text)
            except subprocess.CalledProcessError:
                continue
            parts[1] = f'BOARD "number {seed}"\n%IX0.0 sim\n%QX0.{seed % 8} sim safe={seed % 2}\n'.encode()
            desk.download(parts)
            assert desk.upload() == parts and desk.status()['board'] == f'number {seed}', seed
            done += 1
        tell(f'{done} random projects, {seed - done} others do not build')


# ---- a crowd ----

COUNTING = SEAL.replace('  Count : INT;', '  Count : INT;\n  Scans : DINT;').replace(
    'PROGRAM Main LD\n', 'PROGRAM Main LD\nRUNG\n  | NO SYS_ALWAYS_ON | ADD IN1:=Scans IN2:=1 OUT=>Scans |\n')


RATE = 10000  # frames of junk in a second


def disturb(path, stop, draw, counts, began):
    """Connects, throws junk, reads slowly or not at all."""
    while not stop.is_set():
        try:
            bad = Client(path, hello=draw.random() < 0.5)
            counts['connects'] += 1
            if draw.random() < 0.2:
                bad.stream.setsockopt(link.socket.SOL_SOCKET, link.socket.SO_RCVBUF, 4096)
            bad.stream.setblocking(False)
            junk = b''.join(struct.pack('<IBBH', 4 + 20, draw.randrange(30), 0, draw.randrange(65536)) + draw.randbytes(20)
                            for _ in range(200))
            for _ in range(draw.randrange(1, 8)):
                while counts['frames'] > RATE * (time.monotonic() - began) and not stop.is_set():
                    stop.wait(0.002)
                counts['frames'] += bad.stream.send(junk) // 28
                stop.wait(0.02)
            bad.close()
        except (OSError, Gone, Refused):
            stop.wait(0.002)


def test_a_crowd_disturbs_neither_scans_nor_others():
    draw = random.Random(5)
    wanted = {'connects': 1000, 'frames': 100000} if LONG else {'connects': 30, 'frames': 2000}
    rt = link.in_real_time() if LONG else []
    with Board(COUNTING, *rt) as board:
        desk = board.client()
        quiet = desk.status()
        if LONG:
            time.sleep(10)
            quiet = desk.status()
        stop, counts = threading.Event(), {'connects': 0, 'frames': 0}
        began = time.monotonic()
        crowd = [threading.Thread(target=disturb,
                                  args=(board.socket, stop, random.Random(draw.random()), counts, began))
                 for _ in range(5)]
        for it in crowd:
            it.start()
        longest = 0
        while any(counts[name] < number for name, number in wanted.items()):
            start = time.monotonic()
            assert desk.read('Table[1]') == [1]
            longest = max(longest, time.monotonic() - start)
            time.sleep(0.005)
        took = time.monotonic() - began
        stop.set()
        for it in crowd:
            it.join()
        # Each scan ran once and whole, and nobody without a valid request changed anything.
        first = desk.read('Scans')[0], desk.scan
        until(lambda: desk.read('Scans')[0] > first[0] + 3)
        assert desk.read('Scans')[0] - first[0] == desk.scan - first[1]
        status = desk.status()
        assert status['mode'] == client.RUN and status['forces'] == 0 and status['fault'] == 'none'
        tell(f"{counts['connects']} connects, {counts['frames']} frames of junk in {took:.1f} s "
             f"({counts['frames'] / took:.0f}/s): p99.9 of lateness {quiet['late_p999'] / 1000:.0f} us before, "
             f"{status['late_p999'] / 1000:.0f} us with it; slowest answer {longest * 1000:.0f} ms")
        assert not LONG or longest < 1
        # Without real-time priority other programs of this machine decide.
        assert not rt or status['late_p999'] <= quiet['late_p999'] + 300000, (quiet['late_p999'], status['late_p999'])


test_a_crowd_disturbs_neither_scans_nor_others.as_is = LONG


def watch_for(desk, words, over):
    """Watches so many words as fast as the board sends them. How many messages came."""
    types = desk.publish([f'N{i}' for i in range(words)])[1]
    count = 0
    while not over.is_set():
        desk.next_told()
        count += 1
    assert len(types) == words
    return count


def make_busy(count):
    """Processes that keep so many processors busy, each in a group of its own, and what they are."""
    if not count:
        return [], 'nothing else'
    if shutil.which('stress-ng'):
        commands, what = [['stress-ng', '--quiet', '--cpu', str(count)]], f'stress-ng --cpu {count}'
    else:
        commands, what = [['sh', '-c', 'while :; do :; done']] * count, f'{count} endless loops (stress-ng is not installed)'
    nice = os.getpriority(os.PRIO_PROCESS, 0)
    return [subprocess.Popen(it, start_new_session=True) for it in commands], what + (f', at nice {nice}' if nice else '')


def lateness(rt, desks, words, busy):
    """How late scans of 10 ms began in a time of JITTER: the status, and the messages that desks got."""
    over, counts = threading.Event(), []
    program = link.SEAL.replace('  Count : INT;\n', '  Count : INT;\n' + ''.join(f'  N{i} : INT;\n' for i in range(words)))
    program = program.replace('END_PROGRAM', ''.join(f'RUNG\n  | [ N{i} := N{i} + 1 ] |\n' for i in range(words)) + 'END_PROGRAM')
    with Board(program, '--period', '10ms', *rt) as board:
        # One session is that of the last desk, which asks for the status at the end.
        threads = [threading.Thread(target=lambda desk: counts.append(watch_for(desk, words, over)), args=(board.client(),))
                   for _ in range(desks)]
        last = board.client()
        load, what = make_busy(busy)
        try:
            for it in threads:
                it.start()
            if desks:
                last.publish([f'N{i}' for i in range(words)])
            end = time.monotonic() + JITTER
            while time.monotonic() < end:
                if desks:
                    last.next_told()
                else:
                    time.sleep(1)
            status = last.status()
        finally:
            over.set()
            for it in load:
                os.killpg(it.pid, signal.SIGKILL)
                it.wait()
            for it in threads:
                it.join()
        return status, sum(counts), what


def test_desks_and_busy_processors_delay_no_scan():
    if not JITTER:
        raise link.Skip('JITTER=60 measures it')
    rt = link.in_real_time()
    decides = bool(rt)
    rt = [] if WITHOUT_RT else rt
    quiet, _none, alone = lateness(rt, 0, 200, 0)
    status, messages, load = lateness(rt, 7, 200, os.cpu_count())
    for what, it in ('no desk, ' + alone, quiet), ('8 desks, ' + load, status):
        tell(f"{what}: {it['scans']} scans of 10 ms, {it['missed']} missed, late p99.9 {it['late_p999'] / 1000:.0f} us, "
             f"at most {it['late_longest'] / 1000:.0f} us")
    tell(f"{messages} messages of 200 words to 7 of them; {' '.join(rt) or 'no real-time priority'}" +
         ('' if decides else ': nothing is decided'))
    if decides:
        assert status['missed'] == 0 and status['late_p999'] <= min(10**6, quiet['late_p999'] + 300000), (quiet, status)


test_desks_and_busy_processors_delay_no_scan.as_is = True


def test_ten_thousand_variables_are_watched():
    many = ''.join(f'  N{i} : INT;\n' for i in range(10000))
    with Board(SEAL.replace('  Count : INT;\n', '  Count : INT;\n' + many)) as board:
        desks = [board.client() for _ in range(8)]
        refused(11, lambda: desks[0].publish([f'N{i}' for i in range(2049)]), '2048')
        for number, desk in enumerate(desks):
            desk.types = desk.publish([f'N{i}' for i in range(number * 1250, (number + 1) * 1250)])[1]
        desks[3].write({'N0': (INT, 5), 'N9999': (INT, 6)})
        for number, desk in enumerate(desks):
            seen = {}
            wanted = {0: {0: 5}, 7: {1249: 6}}.get(number, {})
            while len(seen) < 1250 or any(seen[index] != (0, it) for index, it in wanted.items()):
                seen.update(client.take_values(desk.next_told()[1], desk.types)[4])
            assert sum(it[1] != 0 for it in seen.values()) == len(wanted)
        # One more desk than there are sessions is told so.
        refused(16, board.client)


# ---- trouble in a download ----

def test_a_desk_that_sleeps_in_a_download():
    with slots() as board:
        sleeper = board.client()
        parts = build(board, 'other.rung', OTHER)
        sleeper.begin(parts)
        sleeper.call(client.BLOCK, struct.pack('<I', 0) + parts[0][:700])
        status, _out, err = board.command('download', 'other.rung', 'board.io', '--yes')
        assert status == 1 and 'LD844: another desk downloads to this board: wait' in err, err
        before = board.client().status()
        assert before['mode'] == client.RUN
        sleeper.close()
        until(lambda: board.command('download', 'other.rung', 'board.io', '--yes')[0] == 0)
        assert board.client().status()['program'] != before['program']


def test_a_cable_pulled_in_each_state_of_a_download():
    with slots() as board:
        known = {}
        for number in (3, 4):
            made = build(board, f'p{number}.rung', OTHER.replace('T#9s', f'T#{number}s'))
            known[board.client().download(made)[1]] = made
        steps = ['begin', 'half a frame', 'one block', 'pieces', 'all blocks', 'verify asked', 'verified', 'commit cut',
                 'commit sent', 'committed']
        for step in steps:
            desk = board.client()
            now = desk.status()['program']
            parts = next(it for identity, it in known.items() if identity != now)
            data = b''.join(parts)
            reached = steps.index(step)
            expect = desk.expect()
            desk.begin(parts)
            block = struct.pack('<I', 0) + data[:500]
            if step == 'half a frame':
                desk.stream.sendall((struct.pack('<IBBH', 4 + len(block), client.BLOCK, 0, 99) + block)[:200])
            if reached >= 2:
                desk.call(client.BLOCK, block)
            if reached >= 3:
                desk.pieces(500, data[500:900])
            if reached >= 4:
                desk.send_from(data, 900)
            if step == 'verify asked':
                desk.send(client.VERIFY, b'')
            if reached >= 6:
                desk.verify()
            commit = struct.pack('<IBBH', 4 + 34, client.COMMIT, 0, 77) + expect + b'\0'
            if step == 'commit cut':
                desk.stream.sendall(commit[:-1])
            if step == 'commit sent':
                desk.stream.sendall(commit)
            if step == 'committed':
                desk.commit()
            desk.close()
            other = board.client()
            until(lambda: other.status()['sessions'] == 1)  # pylint: disable=cell-var-from-loop
            found = other.status()
            assert found['mode'] == client.RUN and found['program'] in known, step
            assert step == 'commit sent' or (found['program'] != now) == (step == 'committed'), step
            assert other.upload() == known[found['program']], step
            # Another desk takes over, whatever had come.
            parts = next(it for identity, it in known.items() if identity != found['program'])
            other.download(parts)
            assert other.upload() == parts, step
            other.close()


def test_a_full_disk():
    with slots() as board:
        desk = board.client()
        parts = build(board, 'other.rung', OTHER)
        before = desk.status()['program']
        resource.prlimit(board.daemon.pid, resource.RLIMIT_FSIZE, (1000, resource.RLIM_INFINITY))
        status, _out, err = board.command('download', 'other.rung', 'board.io', '--yes')
        assert status == 1 and 'LD825' in err and 'the old one runs on. Make room on its disk' in err and 'prog.A' in err, err
        assert desk.status()['program'] == before and desk.status()['mode'] == client.RUN
        resource.prlimit(board.daemon.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        desk.download(parts)
        assert desk.upload() == parts
        assert not [it for it in os.listdir(board.folder) if it.startswith('prog.') and it != 'prog.A']


def test_two_desks_download_at_once():
    with slots() as board:
        texts = [OTHER.replace('T#9s', f'T#{number}s') for number in (3, 4)]
        for number, text in enumerate(texts):
            board.write(f'p{number}.rung', text)
        good = 0
        for _ in range(20 if LONG else 4):
            results = [None, None]

            def download(number):
                results[number] = board.command('download', f'p{number}.rung', 'board.io', '--yes')  # pylint: disable=cell-var-from-loop

            both = [threading.Thread(target=download, args=(number,)) for number in (0, 1)]
            for it in both:
                it.start()
            for it in both:
                it.join()
            for status, _out, err in results:
                assert status == 0 or (status == 1 and ('LD844' in err or 'LD806' in err)), err
            assert any(status == 0 for status, _out, _err in results)
            good += 1
            assert any(board.client().upload()[2].endswith(text.encode()) for text in texts)
        assert good


JUMP = '''#define _GNU_SOURCE
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
int clock_gettime(clockid_t clock, struct timespec *out)
{
	static unsigned calls;
	long result = syscall(SYS_clock_gettime, clock, out);
	if (clock == CLOCK_REALTIME && ++calls % 7 > 3)
		out->tv_sec += calls % 2 ? 40000000 : -40000000;
	return (int)result;
}
'''


def test_a_clock_that_jumps():
    """The clock of the wall jumps by a year, there and back; scans and sessions use another one."""
    with Board(COUNTING, '--slots', '.') as board:
        board.stop()
        board.write('jump.c', JUMP)
        made = subprocess.run(['cc', '-shared', '-fPIC', '-o', 'jump.so', 'jump.c'], cwd=board.folder, capture_output=True)
        if made.returncode:
            raise link.Skip('no cc')
        os.environ['LD_PRELOAD'] = board.folder + '/jump.so'
        board.start(wait=False)
        del os.environ['LD_PRELOAD']
        until(lambda: link.reached(board, lambda it: True))
        desk = board.client()
        _request, types = desk.publish(['Scans'])
        for number in range(40):
            desk.write({'Count': (INT, number)})
            client.take_values(desk.next_told()[1], types)
        desk.download(build(board, 'other.rung', COUNTING.replace('T#2s', 'T#3s')))
        events = desk.events()
        times = [it['time'] for it in events]
        if max(times) - min(times) < 10 ** 15:
            raise link.Skip('the clock did not jump: a static ladderd')
        assert [it['number'] for it in events] == list(range(1, len(events) + 1))
        assert [it['args'][0] for it in events if it['id'] == 6] == [f'Count={i}' for i in range(40)]
        status = desk.status()
        assert status['mode'] == client.RUN and status['late_longest'] < 10 ** 10


if __name__ == '__main__':
    link.PROGRAMS += ('tests/bin/ladder_random',)
    sys.exit(link.main(globals()))
