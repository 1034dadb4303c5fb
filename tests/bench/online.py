#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""online - the figures of `make bench-online`: what the link of ladderd costs and how fast it answers, with a
client in Python on the same machine. Nothing fails: the figures depend on the load of the machine.

  SECONDS=20   how long each of the measurements of lateness takes

ladderd has real-time priority, if this user may give it that; lateness is also measured without. Whatever else the machine
does shows in all figures: the head and the last line tell its load.
"""
import os
import platform
import re
import shutil
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', 'online'))
import link  # noqa: E402
from client import Client  # noqa: E402

BUILD = os.path.abspath(os.environ.get('BUILD', 'build'))
SECONDS = float(os.environ.get('SECONDS', 20))
MAP = 'BOARD "bench"\n%IX0.0 sim\n%QX0.0 sim\n'


def program(rungs, preset=1, words=1000):
    names = ''.join(f'  W{i} : DINT;\n' for i in range(words))
    body = ''.join(f'RUNG\n  | NO In | NC M{i} | TON T{i} PT:=T#{preset}s | COIL M{i} |\n' for i in range(rungs))
    blocks = ''.join(f'  T{i} : TON;\n  M{i} : BOOL;\n' for i in range(rungs))
    moves = ''.join(f'RUNG\n  | NO SYS_ALWAYS_ON | ADD IN1:=W{i} IN2:=1 OUT=>W{i} |\n' for i in range(words))
    return ('RUNGBOARD 1\nPROJECT "Bench"\n\nVAR\n  In AT %IX0.0 : BOOL;\n  Out AT %QX0.0 : BOOL;\n' + names + blocks +
            'END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO In | COIL Out |\n' + moves + body + 'END_PROGRAM\n')


class Board:
    """A ladderd as a user of its own if this is root, which has no role."""

    def __init__(self, text, *options):
        self.folder = tempfile.mkdtemp()
        os.chmod(self.folder, 0o777)
        with open(self.folder + '/group', 'w') as out:
            out.write(f'ladder-eng:x:{os.getgid()}:\n')
        for name, content in (('p.rung', text), ('b.io', MAP)):
            with open(f'{self.folder}/{name}', 'w') as out:
                out.write(content)
        self.daemon = subprocess.Popen(
            [BUILD + '/ladderd', 'p.rung', '--io', 'b.io', '--link', 'link', '--groups', 'group', '--slots', '.',
             *options], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while True:
            try:
                self.client().close()
                return
            except OSError:
                time.sleep(0.02)

    def client(self):
        return Client(self.folder + '/link')

    def build(self, text):
        with open(self.folder + '/n.rung', 'w') as out:
            out.write(text)
        subprocess.run([BUILD + '/ladder', 'build', 'n.rung', '-o', 'n.c'], cwd=self.folder, check=True,
                       capture_output=True)
        with open(self.folder + '/n.c', 'rb') as image:
            return [image.read(), MAP.encode(), b'\0\0']

    def write(self, name, text):
        with open(f'{self.folder}/{name}', 'w') as out:
            out.write(text)

    def close(self):
        self.daemon.terminate()
        self.daemon.wait()
        shutil.rmtree(self.folder)


class FarClient(Client):
    """A session through ssh on this machine."""

    def __init__(self, server):  # pylint: disable=super-init-not-called
        self.stream, far = socket.socketpair()
        self.stream.settimeout(60)
        self.ssh = subprocess.Popen(
            ['ssh', '-F', '/dev/null', '-i', server.folder + '/key', '-p', str(server.port), '-o', 'IdentitiesOnly=yes',
             '-o', f'UserKnownHostsFile={server.folder}/known', '127.0.0.1'], stdin=far, stdout=far,
            stderr=subprocess.DEVNULL)
        far.close()
        self.request, self.told = 0, []
        self.hello()

    def close(self):
        super().close()
        self.ssh.wait()


def row(what, value, want):
    print(f'{what:<70} {value:>16}   {want}')


def load():
    return 'load of the machine: ' + ' '.join(f'{it:.1f}' for it in os.getloadavg())


RT = link.real_time()


def lateness(clients, options):
    """(missed scans, p99.9 of lateness in us, processor of the link in %) over SECONDS."""
    board = Board(program(0), *options)
    done = threading.Event()
    names = [f'W{i}' for i in range(1000)]

    def watch(desk):
        desk.publish(names, 40000)
        desk.stream.settimeout(1)
        while not done.is_set():
            try:
                desk.receive(65536)
            except OSError:
                return

    threads = [threading.Thread(target=watch, args=(board.client(),), daemon=True) for _ in range(clients)]
    for thread in threads:
        thread.start()
    tick = os.sysconf('SC_CLK_TCK')

    def used():
        """Ticks of all threads but the first, which scans."""
        total = 0
        for task in os.listdir(f'/proc/{board.daemon.pid}/task'):
            if int(task) != board.daemon.pid:
                with open(f'/proc/{board.daemon.pid}/task/{task}/stat') as stat:
                    fields = stat.read().rsplit(')', 1)[1].split()
                    total += int(fields[11]) + int(fields[12])
        return total

    before = used()
    time.sleep(SECONDS)
    share = (used() - before) / tick / SECONDS * 100
    done.set()
    for thread in threads:
        thread.join()
    status = board.client().status()
    board.close()
    return status['missed'], status['late_p999'] / 1000, share


def all_lateness(how, options):
    missed, alone, _share = lateness(0, options)
    row('nobody watches: p99.9 of lateness' + how, f'{alone:.0f} us', '')
    row('  missed scans', str(missed), '0')
    missed, late, share = lateness(8, options)
    row('8 desks watch 1,000 changing variables at 25 Hz: p99.9' + how, f'{late:.0f} us', f'≤ {alone + 300:.0f} us')
    row('  missed scans', str(missed), '0')
    row('  link thread', f'{share:.1f} % of a core', '≤ 10 %')


def reads(desk, where, limit):
    names = [f'W{i}' for i in range(100)]
    places = [it[2] for name, it in desk.symbols().items() if name in names]
    for how, refs in (('by name', names), ('by place', places)):
        times = []
        for _ in range(300):
            began = time.perf_counter()
            desk.read(*refs)
            times.append((time.perf_counter() - began) * 1000)
        row(f'read of 100 variables {how}{where}, median', f'{statistics.median(times):.2f} ms', f'≤ {limit} ms')


def far_server(board):
    """A real sshd for this board; None: this machine has none."""
    link.BUILD = BUILD
    try:
        if not os.path.exists('/usr/sbin/sshd'):
            raise link.Skip('no sshd')
        return link.Sshd(board)
    except link.Skip as why:
        row('over ssh', 'not measured', str(why))
        return None


def over_ssh(two):
    """Downloads every byte of 10,000 rungs through ssh."""
    board = Board(program(10000), *RT)
    server = far_server(board)
    if server:
        desk = FarClient(server)
        times = []
        for turn in range(7):
            began = time.perf_counter()
            desk.download(two[turn % 2])
            times.append((time.perf_counter() - began) * 1000)
        status = desk.status()
        row('the same over ssh', f'{statistics.median(times):.0f} ms', '≤ 1000 ms')
        row('  missed scans', str(status['missed']), '0')
        row('  switch: longest lateness of a scan', f"{status['late_longest'] / 1000:.0f} us", '≤ 1 scan: 10000 us')
        desk.close()
        server.close()
    board.close()


def some_changes():
    """What `ladder board download` sends, and how long it takes without the translation."""
    text = program(10000)
    board = Board(text, *RT)
    row('a change of 10,000 rungs, by `ladder board download`', 'sent', 'of image, map, sources')
    one = text.replace('T5000 PT:=T#1s', 'T5000 PT:=T#8s')
    rung = text.replace('RUNG\n  | NO In | NC M5000 |', 'RUNG\n  | NO In | NC M4999 | COIL Out |\nRUNG\n  | NO In | NC M5000 |')
    name = text.replace('  W500 : DINT;\n', '  W500 : DINT;\n  Added : DINT;\n')
    for what, changed in (('the first download, with sources', text), ('nothing', text), ('one number', one), ('one more rung', rung),
                          ('one more variable', name)):
        board.write('n.rung', text)
        subprocess.run([BUILD + '/ladder', 'board', 'unix:link', 'download', 'n.rung', 'b.io', '--yes'], cwd=board.folder,
                       capture_output=True, check=True) if what not in ('the first download, with sources', 'nothing') else None
        board.write('n.rung', changed)
        began = time.perf_counter()
        subprocess.run([BUILD + '/ladder', 'build', 'n.rung', '-o', 'n.c'], cwd=board.folder, capture_output=True, check=True)
        built = time.perf_counter()
        done = subprocess.run([BUILD + '/ladder', 'board', 'unix:link', 'download', 'n.rung', 'b.io', '--yes'],
                              cwd=board.folder, capture_output=True, text=True, check=True)
        took = time.perf_counter() - built - (built - began)
        sent, size = map(int, re.search(r'sent (\d+) of (\d+) bytes', done.stdout).groups())
        row(f'  {what}', f'{sent} bytes', f'{100 * sent / size:.1f} % of {size}, {max(0, took) * 1000:.0f} ms')
    board.close()


def main():
    with open('/proc/cpuinfo') as info:
        cpu = next((line.split(':')[1].strip() for line in info if line.startswith('model name')), platform.machine())
    commit = subprocess.run(['git', 'rev-parse', '--short', 'HEAD'], capture_output=True, text=True, cwd=HERE)
    print(f'{cpu}, {os.cpu_count()} cores, {platform.release()}, commit {commit.stdout.strip() or "?"}\nladderd {" ".join(RT) or "without --rt"}; {load()}\n')
    board = Board(program(100), *RT)
    reads(board.client(), '', 1)
    server = far_server(board)
    if server:
        far = FarClient(server)
        reads(far, ' over ssh', 5)
        far.close()
        server.close()
    board.close()
    board = Board(program(10000), *RT)
    desk = board.client()
    two = [board.build(program(10000, preset)) for preset in (2, 3)]
    times = []
    for turn in range(7):
        parts = two[turn % 2]
        began = time.perf_counter()
        desk.download(parts)
        times.append((time.perf_counter() - began) * 1000)
    row(f'download of 10,000 rungs ({len(two[0][0]) >> 10} KB) until they run, median', f'{statistics.median(times):.0f} ms',
        '≤ 1000 ms')
    row('  missed scans', str(desk.status()['missed']), '0')
    board.close()
    over_ssh(two)
    some_changes()
    all_lateness('', [])
    if RT:
        all_lateness(', ' + ' '.join(RT), RT)
    print('\n' + load())


if __name__ == '__main__':
    sys.exit(main())
