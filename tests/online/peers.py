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
import tempfile
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

    def __init__(self, network, name, program, board, *options):
        self.network, self.name, self.peer = network, name, None
        super().__init__(program, *options, board=board)
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
        soon(tank, {'Level': 5})
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

    def __init__(self, network, where, address=None):
        code = ('import socket, sys\n'
                's = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n'
                's.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(sys.argv[1]))\n'
                'for line in sys.stdin:\n'
                '    to, data = line.rstrip("\\n").split(" ")\n'
                f'    s.sendto(bytes.fromhex(data), (to, {PORT}))\n'
                '    print(flush=True)\n')
        address = address or f'10.77.0.{network.names.index(where)}'
        self.process = subprocess.Popen(network.command(where, sys.executable, '-c', code, address),
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def send(self, data, to=GROUP):
        self.process.stdin.write(f'{to} {data.hex()}\n')
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


def says(board, text, times=1):
    """Waits until the ladder-peer of a board has said this so often; it says it no more often."""
    try:
        until(lambda: board.read('peer').count(text) >= times)
    except AssertionError as error:
        raise AssertionError(f'{text!r}: {board.read("peer")}') from error
    assert board.read('peer').count(text) == times, board.read('peer')


def gateway_text(board):
    desk = board.client()
    found = desk.status()['gateways']['peer']['text']
    desk.close()
    return found


def test_what_the_command_takes():
    with tempfile.TemporaryDirectory() as folder:
        for words, status, out, err in [(['--help'], 0, 'usage: ladder-peer', ''), (['--version'], 0, 'ladder-peer ', ''),
                                        (['--link'], 2, '', '--link is not understood; see ladder-peer --help'),
                                        (['--fly'], 2, '', '--fly is not understood'), (['link', 'x'], 2, '', 'link is not understood')]:
            done = subprocess.run([link.BUILD + '/ladder-peer', *words], capture_output=True, text=True, timeout=60, cwd=folder, check=False)
            assert done.returncode == status and done.stdout.startswith(out) and err in done.stderr, (words, done)
            assert bool(done.stdout) == (status == 0) and bool(done.stderr) == (status != 0), (words, done)
        # Nobody listens there: it says so once, goes on trying, and ends in order.
        with open(folder + '/said', 'w+', encoding='utf-8') as said:
            peer = subprocess.Popen([link.BUILD + '/ladder-peer', '--link', folder + '/link'], stdout=said, stderr=said, stdin=subprocess.DEVNULL)

            def tried():
                said.seek(0)
                return said.read()

            until(tried)
            time.sleep(1.2)  # two more attempts
            peer.send_signal(signal.SIGINT)
            assert peer.wait(30) == 0
            assert tried().count('\n') == 1 and tried().startswith(f'ladder-peer: {folder}/link: '), tried()


def test_ladderd_goes_and_comes():
    with Network('pump', 'tank') as network, PeerBoard(network, 'pump', PUMP, PUMP_MAP) as pump, \
            PeerBoard(network, 'tank', TANK, TANK_MAP) as tank:
        soon(tank, {'Level': 5})
        # ladderd ends: its ladder-peer says so once and sends nothing that is old.
        pump.daemon.send_signal(signal.SIGKILL)
        pump.daemon.wait(60)
        soon(tank, {'Level': -1})
        until(lambda: f'ladder-peer: {pump.socket}: ' in pump.read('peer'))
        pump.start()
        soon(tank, {'Level': 5})
        # ladderd hangs: what it said last is not sent as if it were new.
        pump.daemon.send_signal(signal.SIGSTOP)
        soon(tank, {'Level': -1})
        pump.daemon.send_signal(signal.SIGCONT)
        soon(tank, {'Level': 5})
        # A second ladder-peer of the same board is refused, and goes on when the first one has ended.
        first = pump.peer
        pump.start_peer()
        until(lambda: 'LD8' in pump.read('peer').split('\n', 2)[-1] or pump.read('peer').count('ladder-peer: ' + pump.socket) > 1)
        soon(tank, {'Level': 5})
        first.send_signal(signal.SIGTERM)
        assert first.wait(30) == 0
        desk = pump.client()
        desk.write({'Level': (INT, 9)})
        soon(tank, {'Level': 9})
        assert pump.end_peer() == 0


test_ladderd_goes_and_comes.root = True


def test_the_interface_goes_and_comes():
    with Network('pump', 'tank') as network:
        there = BUS.replace('eth0', 'eth9')
        with PeerBoard(network, 'pump', PUMP, PUMP_MAP.replace(BUS, there)) as pump, \
                PeerBoard(network, 'tank', TANK, TANK_MAP) as tank:
            says(pump, f'ladder-peer: {GROUP} on eth9: no such network interface; `ip link` lists those of this machine\n')
            until(lambda: gateway_text(pump) == '0 datagrams sent, 0 strange, no such network interface')
            # It comes, without an address at first.
            ip('-n', network.prefix + 'pump', 'link', 'set', 'eth0', 'down')
            ip('-n', network.prefix + 'pump', 'link', 'set', 'eth0', 'name', 'eth9')
            ip('-n', network.prefix + 'pump', 'addr', 'flush', 'dev', 'eth9')
            says(pump, f'ladder-peer: {GROUP} on eth9: the interface has no address; give it one\n')
            ip('-n', network.prefix + 'pump', 'addr', 'add', '10.77.0.1/24', 'dev', 'eth9')
            ip('-n', network.prefix + 'pump', 'link', 'set', 'eth9', 'up')
            says(pump, f'ladder-peer: {GROUP} on eth9: ready\n')
            soon(tank, {'Level': 5})
            # It is switched off on the board itself.
            ip('-n', network.prefix + 'pump', 'link', 'set', 'eth9', 'down')
            soon(tank, {'Level': -1})
            says(pump, f'ladder-peer: {GROUP} on eth9: the interface is down; plug its cable in and switch it on\n')
            until(lambda: gateway_text(pump).endswith(', the interface is down'))
            ip('-n', network.prefix + 'pump', 'link', 'set', 'eth9', 'up')
            soon(tank, {'Level': 5})
            says(pump, f'ladder-peer: {GROUP} on eth9: ready\n', 2)
            until(lambda: gateway_text(pump).endswith(' strange'))
            # It is pulled out and another one is plugged in, of the same name.
            ip('-n', network.prefix + 'tank', 'link', 'del', 'eth0')
            says(tank, f'ladder-peer: {GROUP} on eth0: no such network interface; `ip link` lists those of this machine\n')
            soon(tank, {'Level': -1})
            network.add(2, 'tank')
            says(tank, f'ladder-peer: {GROUP} on eth0: ready\n', 2)
            soon(tank, {'Level': 5})


test_the_interface_goes_and_comes.root = True


def test_another_program_has_the_port():
    with Network('pump', 'tank') as network, PeerBoard(network, 'tank', TANK, TANK_MAP) as tank:
        code = f'import socket\ns = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\ns.bind(("", {PORT}))\nprint(flush=True)\ninput()\n'
        with subprocess.Popen(network.command('pump', sys.executable, '-c', code), stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            assert holder.stdout.readline() == b'\n'
            with PeerBoard(network, 'pump', PUMP, PUMP_MAP) as pump:
                says(pump, f'ladder-peer: {GROUP} on eth0: another program has this port; end that program, or write another port in group=\n')
                until(lambda: gateway_text(pump) == '0 datagrams sent, 0 strange, another program has this port')
                holder.communicate(b'\n', 30)
                says(pump, f'ladder-peer: {GROUP} on eth0: ready\n')
                soon(tank, {'Level': 5})


test_another_program_has_the_port.root = True


def test_lines_of_one_board():
    """They count together. A text is no value of a datagram: the others of its line are sent."""
    program = PUMP.replace('  Neg : INT := -2;', "  Neg : INT := -2;\n  Label : STRING := 'pump';")
    board_map = ('BOARD "pump"\n' + BUS + 'PUBLISH pump-house Level, Label, Flow every=50ms\nPUBLISH other Neg every=50ms\n'
                 'PUBLISH Pump-House Running every=20ms\n%QX0.0 sim safe=0\n')
    with Network('pump', 'mixer') as network, PeerBoard(network, 'pump', program, board_map) as pump, \
            PeerBoard(network, 'mixer', MIXER, MIXER_MAP.replace('name=Flow', 'name=Label')) as mixer:
        soon(mixer, {'Level': 5, 'Running': False})
        desk = pump.client()
        desk.write({'Level': (INT, 8), 'Go': (BOOL, True)})
        soon(mixer, {'Level': 8, 'Running': True, 'Flow': 0.0})
        until(lambda: units(mixer)['yard/pump-house'][0] > 20)
        assert units(mixer)['yard/pump-house'][1:] == (0, 0) and len(units(mixer)) == 1, units(mixer)


test_lines_of_one_board.root = True


def test_another_map():
    """With it buses and boards come and go; a map without them closes the sockets."""
    with Network('pump', 'tank') as network, PeerBoard(network, 'pump', PUMP, PUMP_MAP, '--slots', '.') as pump, \
            PeerBoard(network, 'tank', TANK, TANK_MAP, '--slots', '.') as tank:

        def exchange(text):
            tank.write('other.io', text)
            done = tank.command('download', 'program.rung', 'other.io', '--yes')
            assert done[0] == 0, done

        def sockets():
            # The kernel lists the UDP sockets of the namespace; in hex, the port stands behind the group.
            lines = subprocess.run(network.command('tank', 'cat', '/proc/net/udp'), capture_output=True, text=True, timeout=60, check=True).stdout
            return sorted(int(line.split()[1].split(':')[1], 16) for line in lines.splitlines()[1:])

        soon(tank, {'Level': 5})
        assert sockets() == [PORT]
        # Two buses in one group: the port tells them apart. A bus that no line names has no socket, nor has one of Modbus.
        two = ('BUS idle peer interface=eth0 group=239.192.20.9:20029\nBUS m modbus-tcp host=127.0.0.1:9\n'
               f'BUS side peer interface=eth0 group={GROUP}:20021\n' + BUS)
        lines = '%IW0 peer from=pump-house name=Level stale=500ms substitute=-1 bus={}\n%IW2 peer from=pump-house name=Neg stale=500ms ' \
                'substitute=-1 bus={}\n%QX0.0 sim safe=0\n'
        exchange('BOARD "tank"\n' + two + lines.format('side', 'yard'))
        soon(tank, {'Level': -1, 'Twice': -2})
        assert sockets() == [PORT, 20021]
        until(lambda: set(units(tank)) == {'side/pump-house', 'yard/pump-house'})
        until(lambda: units(tank)['yard/pump-house'][0] > 0)
        assert units(tank)['side/pump-house'] == (0, 0, 0), units(tank)
        exchange('BOARD "tank"\n%IW0 sim\n%IW2 sim\n%QX0.0 sim safe=0\n')
        until(lambda: sockets() == [])
        until(lambda: not units(tank))
        exchange(TANK_MAP)
        soon(tank, {'Level': 5})
        # The sender gets another map: a board counts on each bus alone.
        pump.write('other.io', 'BOARD "pump"\n' + two + 'PUBLISH pump-house Neg every=20ms bus=side\nPUBLISH pump-house Flow every=50ms bus=yard\n'
                   '%QX0.0 sim safe=0\n')
        assert pump.command('download', 'program.rung', 'other.io', '--yes')[0] == 0
        soon(tank, {'Level': -1})
        exchange('BOARD "tank"\n' + two + lines.format('side', 'yard').replace('name=Level', 'name=Neg'))
        soon(tank, {'Level': -2})
        until(lambda: units(tank)['yard/pump-house'][0] > 3)
        assert all(it[0] and it[1:] == (0, 0) for it in units(tank).values()), units(tank)


test_another_map.root = True


def test_more_than_there_is_room_for():
    """64 boards are reported; all are heard. A heap of datagrams that waited is taken, the newest value counts."""
    names = [f'board{i}' for i in range(80)]
    board_map = 'BOARD "tank"\n' + BUS + ''.join(f'%IW{2 * i} peer from={it} name=Level stale=30s substitute=-1\n' for i, it in enumerate(names)) + \
        '%QX0.0 sim safe=0\n'
    program = TANK.replace('Twice AT %IW2', 'Twice AT %IW158')
    with Network('tank', 'one') as network, PeerBoard(network, 'tank', program, board_map) as tank, Stranger(network, 'one') as one:
        until(lambda: 'ready' in tank.read('peer'))
        for i, it in enumerate(names):
            one.send(datagram(it, 1, [('Level', INT, 1, struct.pack('<h', 100 + i))]))
        soon(tank, {'%IW0': 100, '%IW2': 101, '%IW126': 163, '%IW128': 164, '%IW158': 179})
        until(lambda: len(units(tank)) == 64)
        # As many as the socket holds while nobody reads it.
        tank.peer.send_signal(signal.SIGSTOP)
        for i in range(2, 602):
            one.send(datagram('board0', i, [('Level', INT, 1, struct.pack('<h', i))]))
        tank.peer.send_signal(signal.SIGCONT)
        one.send(datagram('board0', 602, [('Level', INT, 1, struct.pack('<h', 602))]))
        until(lambda: units(tank)['yard/board0'][0] > 100)
        one.send(datagram('board0', 603, [('Level', INT, 1, struct.pack('<h', 603))]))
        soon(tank, {'%IW0': 603})
        time.sleep(1.2)
        taken, refused, lost = units(tank)['yard/board0']
        assert refused == 0 and taken + lost == 603, (taken, refused, lost)


test_more_than_there_is_room_for.root = True


def test_who_is_not_of_the_network_is_strange():
    """An address of another network, a datagram to the board alone, an empty one, one that is too long: counted, not taken."""
    with Network('tank', 'one') as network, PeerBoard(network, 'tank', TANK, TANK_MAP.replace('stale=500ms', 'stale=30s')) as tank:
        until(lambda: 'ready' in tank.read('peer'))
        ip('-n', network.prefix + 'one', 'addr', 'add', '10.78.0.2/24', 'dev', 'eth0')
        ip('-n', network.prefix + 'tank', 'route', 'add', '10.78.0.0/24', 'dev', 'eth0')
        with Stranger(network, 'one') as one, Stranger(network, 'one', '10.78.0.2') as other:
            one.send(level(1, 11))
            soon(tank, {'Level': 11})
            for i in range(70):
                other.send(level(2 + i, 66))
            one.send(level(1, 66), '10.77.0.1')
            one.send(b'')
            one.send(b'x' * 3000)
            until(lambda: gateway_text(tank) == '0 datagrams sent, 72 strange')
            one.send(level(2, 12))
            soon(tank, {'Level': 12})
            until(lambda: units(tank)['yard/pump-house'] == (2, 0, 0))
            # The network of that address becomes one of the interface.
            ip('-n', network.prefix + 'tank', 'addr', 'add', '10.78.0.1/24', 'dev', 'eth0')
            time.sleep(1.2)  # it looks each second
            other.send(datagram('mixer', 1, [('Twice', INT, 1, b'\7\0')]))
            soon(tank, {'Level': 12, 'Twice': 7})


test_who_is_not_of_the_network_is_strange.root = True


if __name__ == '__main__':
    link.PROGRAMS += ('ladder-peer',)
    sys.exit(link.main(globals()))
