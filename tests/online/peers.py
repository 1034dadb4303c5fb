#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""peers - boards that tell each other variables: a ladderd and a ladder-peer each, in network namespaces of their own.

The namespaces have a bridge between them and no way to any other network. A stranger among them speaks the datagrams of
docs/peer.md, made from that page alone.
"""
import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import client  # noqa: E402
import link  # noqa: E402
from client import BOOL, INT, crc32c  # noqa: E402
from link import Board, Skip, until  # noqa: E402

GROUP, PORT = '239.192.20.1', 20020
BUS = 'BUS yard peer interface=eth0\n'
PUMP = '''RUNGBOARD 1
PROJECT "Pump"

VAR
  Level : INT := 5;
  Running AT %QX0.0 : BOOL;
  Go : BOOL;
  Flow : REAL := 1.5;
  Neg : INT := -2;
END_VAR

PROGRAM Main LD
RUNG
  | NO Go | COIL Running |
END_PROGRAM
'''
PUMP_MAP = 'BOARD "pump"\n' + BUS + 'PUBLISH pump-house Level, Running, Flow, Neg every=50ms\n%QX0.0 sim safe=0\n'
MIXER = '''RUNGBOARD 1
PROJECT "Mixer"

VAR
  Level AT %IW0 : INT;
  Running AT %IX10.0 : BOOL;
  Flow AT %ID4 : REAL;
  Bits AT %IW12 : WORD;
  Small AT %IB20 : USINT;
  Twice : INT;
END_VAR

PROGRAM Main LD
RUNG
  | [ Twice := Level * 2 ] |
END_PROGRAM
'''
MIXER_MAP = ('BOARD "mixer"\n' + BUS + 'PUBLISH mixer Twice every=50ms\n'
             '%IW0 peer from=pump-house name=Level stale=500ms substitute=-1\n'
             '%IX10.0 peer from=Pump-House name=running stale=500ms substitute=0\n'
             '%ID4 peer from=pump-house name=Flow stale=500ms as=REAL\n'
             '%IW12 peer from=pump-house name=Neg stale=500ms\n'
             '%IB20 peer from=pump-house name=Neg stale=500ms substitute=9\n')
TANK = '''RUNGBOARD 1
PROJECT "Tank"

VAR
  Level AT %IW0 : INT;
  Twice AT %IW2 : INT;
END_VAR

PROGRAM Main LD
RUNG
  | [ Level + Twice > 0 ] | COIL %QX0.0 |
END_PROGRAM
'''
TANK_MAP = ('BOARD "tank"\n' + BUS + '%IW0 peer from=pump-house name=Level stale=500ms substitute=-1\n'
            '%IW2 peer from=mixer name=Twice stale=500ms substitute=-1\n%QX0.0 sim safe=0\n')


def ip(*words):
    subprocess.run(['ip', *words], check=True, capture_output=True)


class Network:
    """Namespaces with a bridge between them: a cable each."""

    def __init__(self, *names):
        self.prefix = f'rb{os.getpid()}'
        self.names = ('hub', *names)
        os.setgroups([])
        os.setgid(link.GROUPS['eng'])  # what this process asks of boards
        if not shutil.which('ip') or not shutil.which('setpriv'):
            raise Skip('needs ip and setpriv')
        try:
            for name in self.names:
                ip('netns', 'add', self.prefix + name)
            ip('-n', self.hub, 'link', 'add', 'br0', 'type', 'bridge', 'mcast_snooping', '0')
            ip('-n', self.hub, 'link', 'set', 'br0', 'up')
            for number, name in enumerate(names, 1):
                self.add(number, name)
        except subprocess.CalledProcessError as error:
            self.close()
            raise Skip(f'no network namespaces here: {error.stderr.decode().strip()}') from error

    @property
    def hub(self):
        return self.prefix + 'hub'

    def add(self, number, name):
        space = self.prefix + name
        ip('-n', self.hub, 'link', 'add', name, 'type', 'veth', 'peer', 'name', 'eth0', 'netns', space)
        ip('-n', self.hub, 'link', 'set', name, 'master', 'br0', 'up')
        ip('-n', space, 'addr', 'add', f'10.77.0.{number}/24', 'dev', 'eth0')
        ip('-n', space, 'link', 'set', 'lo', 'up')
        ip('-n', space, 'link', 'set', 'eth0', 'up')

    def cable(self, name, plugged):
        ip('-n', self.hub, 'link', 'set', name, 'up' if plugged else 'down')

    def command(self, name, *words):
        """A command of a user with the group ladder-io, in the namespace of a board."""
        return ['ip', 'netns', 'exec', self.prefix + name, 'setpriv', '--reuid=25000', f"--regid={link.GROUPS['io']}", '--clear-groups',
                *words]

    def close(self):
        for name in self.names:
            subprocess.run(['ip', 'netns', 'del', self.prefix + name], check=False, capture_output=True)

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.close()


class PeerBoard(Board):
    """A board with its ladder-peer."""

    def __init__(self, network, name, program, board):
        self.network, self.name, self.peer = network, name, None
        super().__init__(program, board=board)
        self.start_peer()

    def start_peer(self):
        with open(self.folder + '/peer', 'a', encoding='utf-8') as said:
            self.peer = subprocess.Popen(self.network.command(self.name, link.BUILD + '/ladder-peer', '--link', self.socket),
                                         stdout=said, stderr=said, stdin=subprocess.DEVNULL)

    def end_peer(self, with_signal=signal.SIGTERM):
        self.peer.send_signal(with_signal)
        return self.peer.wait(30)

    def stop(self):
        if self.peer.poll() is None:
            self.end_peer()
        return super().stop()


def soon(board, values):
    """Waits until variables of a board have these values; says what else they have."""
    desk, found = board.client(), []

    def has():
        found[:] = desk.read(*values)
        return found == list(values.values())

    try:
        until(has)
    except AssertionError as error:
        raise AssertionError(f'{values}: {found}; {board.read("peer")}') from error
    finally:
        desk.close()


def units(board):
    desk = board.client()
    found = desk.status()['gateways']['peer']['units']
    desk.close()
    return found


def test_three_boards_tell_each_other():
    with Network('pump', 'mixer', 'tank') as network, PeerBoard(network, 'pump', PUMP, PUMP_MAP) as pump, \
            PeerBoard(network, 'mixer', MIXER, MIXER_MAP) as mixer, PeerBoard(network, 'tank', TANK, TANK_MAP) as tank:
        soon(mixer, {'Level': 5, 'Twice': 10, 'Running': False, 'Flow': 1.5, 'Bits': 65534, 'Small': 9})
        soon(tank, {'Level': 5, 'Twice': 10, '%QX0.0': True})
        desk = pump.client()
        desk.write({'Level': (INT, -300), 'Go': (BOOL, True)})
        soon(mixer, {'Level': -300, 'Running': True})
        soon(tank, {'Level': -300, 'Twice': -600})
        # A cable is cut: what comes through it is stale, all else goes on.
        network.cable('pump', False)
        soon(mixer, {'Level': -1, 'Running': False, 'Flow': 1.5})
        soon(tank, {'Level': -1, 'Twice': -2})
        desk.write({'Level': (INT, 7)})
        network.cable('pump', True)
        began = time.monotonic()
        soon(mixer, {'Level': 7, 'Running': True})
        soon(tank, {'Level': 7, 'Twice': 14})
        print(f'# back after {time.monotonic() - began:.2f} s', flush=True)
        until(lambda: units(tank).get('yard/pump-house', (0, 0, 0))[2] > 0)
        # In STOP its values do not move, so they are not new.
        desk.set_mode(0)
        soon(mixer, {'Level': -1})
        desk.set_mode(1)
        soon(mixer, {'Level': 5})  # as it begins
        # A new ladder-peer is the same board.
        pump.end_peer(signal.SIGKILL)
        soon(tank, {'Level': -1})
        pump.start_peer()
        soon(tank, {'Level': 5})
        assert pump.end_peer() == 0
        status, out, err = tank.command('status')
        assert status == 0 and 'gateway peer: 2 points' in out and '  yard/mixer: ' in out, (out, err)


test_three_boards_tell_each_other.root = True


def name(string):
    data = string.encode()
    return bytes([len(data)]) + data


def datagram(board, number, values, run=77, flags=0, version=1, age=0, count=None, tail=b''):
    """values: (name, type, quality, bytes)"""
    data = struct.pack('<IBBHQII', 1380271440, version, flags, len(values) if count is None else count, run, number, age) + name(board)
    data += b''.join(name(it) + bytes([kind, quality]) + value for it, kind, quality, value in values) + tail
    return data + struct.pack('<I', crc32c(data))


class Stranger:
    """A machine in the same network that sends what it likes."""

    def __init__(self, network, where):
        code = ('import socket, sys\n'
                's = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n'
                's.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(sys.argv[1]))\n'
                'for line in sys.stdin:\n'
                f'    s.sendto(bytes.fromhex(line), ("{GROUP}", {PORT}))\n'
                '    print(flush=True)\n')
        number = network.names.index(where)
        self.process = subprocess.Popen(network.command(where, sys.executable, '-c', code, f'10.77.0.{number}'),
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def send(self, data):
        self.process.stdin.write(data.hex() + '\n')
        self.process.stdin.flush()
        assert self.process.stdout.readline() == '\n'

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.process.stdin.close()
        self.process.wait(30)
        self.process.stdout.close()


def level(number, value, **others):
    return datagram('pump-house', number, [('Level', INT, 1, struct.pack('<h', value))], **others)


def test_strangers_change_nothing():
    """The one that speaks first in the name of a board is that board while it speaks."""
    with Network('tank', 'one', 'two') as network, PeerBoard(network, 'tank', TANK, TANK_MAP.replace('stale=500ms', 'stale=30s')) as tank, \
            Stranger(network, 'one') as one, Stranger(network, 'two') as two:
        until(lambda: 'ready' in tank.read('peer'))
        one.send(level(1, 11))
        soon(tank, {'Level': 11})
        bad = [level(2, 66, version=2), level(2, 66, count=2), level(2, 66, tail=b'x'), level(2, 66)[:-1], level(2, 66)[:-5] + b'\0' * 5,
               b'', b'PEER', datagram('', 2, []), datagram('pump-house', 2, [('Level', 20, 1, b'\3abc')]),
               datagram('pump-house', 2, [('Level', 0, 1, b'')]), datagram('pump-house', 2, [('Level', INT, 2, b'\0\0')]),
               datagram('pump-house', 2, [('', INT, 1, b'\0\0')]), datagram('pump-house', 2, [('Level', BOOL, 1, b'\2')]),
               datagram('a' * 64, 2, []), datagram('nobody', 2, [('Level', INT, 1, b'\0\0')]), b'x' * 1401,
               level(2, 66)[:-4] + b'\0' * 1396]
        for data in bad:
            if data:
                one.send(data)
        for data in [level(1, 66), level(0, 66), level(1, 66, run=77)]:
            one.send(data)  # it comes again, or is older
        for i in range(2, 6):
            two.send(level(i, 66, run=5))  # somebody else in its name
        assert level(2, 12) not in bad
        one.send(level(4, 12))
        soon(tank, {'Level': 12})
        one.send(level(1, 13, run=78))  # a new start
        soon(tank, {'Level': 13})
        one.send(level(9, 66, run=77))  # of before
        one.send(datagram('pump-house', 2, [('Level', INT, 1, struct.pack('<h', 66))], run=78, age=60000))  # too old
        one.send(level(3, 66, run=78, flags=1))  # no program runs there
        one.send(datagram('mixer', 1, [('Twice', INT, 1, b'\1\0')]))
        soon(tank, {'Level': 13, 'Twice': 1})
        time.sleep(1.2)  # a report each second
        taken, refused, lost = units(tank)['yard/pump-house']
        assert (taken, refused, lost) == (5, 3 + 4 + 1, 2), (taken, refused, lost)
        # Numbers beyond 2^31 and round.
        one.send(level(0x7fffffff, 20, run=78))
        one.send(level(0xfffffff0, 21, run=78))
        one.send(level(3, 22, run=78))
        soon(tank, {'Level': 22})
        # After a silence it may have another address.
        time.sleep(5.2)
        two.send(level(1, 30, run=6))
        soon(tank, {'Level': 30})


test_strangers_change_nothing.root = True


if __name__ == '__main__':
    link.PROGRAMS += ('ladder-peer',)
    sys.exit(link.main(globals()))
