#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""check - tests the packages of Debian: check.py DEBS AGAIN ROOT [TEST...]

DEBS and AGAIN are folders with the same packages, built twice; ROOT is a tar file of a Debian with
openssh-server and systemd, into which nothing of Rungboard was installed. Needs root: copies of that system
boot as containers, with a network of their own; a desk connects to their sshd. PICTURES=folder keeps pictures
of the editor.
"""
import glob
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import traceback

sys.dont_write_bytecode = True  # a package is built from all files of the tree
from machine import Machine, run, until  # noqa: E402

HERE = os.path.abspath(os.path.dirname(__file__) + '/../..')
BUILD = os.path.abspath(os.environ.get('BUILD', 'build'))
ARCH = subprocess.run(['dpkg', '--print-architecture'], text=True, capture_output=True, check=True).stdout.strip()
ARCHES = ('amd64', 'arm64', 'armhf')
CONFIG = '/etc/default/ladderd'
DROP_IN = '/usr/share/doc/rungboard-runtime/examples/sshd-ladder.conf'
SLOTS = '/var/lib/rungboard'
KEEPS = '''RUNGBOARD 1
PROJECT "Keeps"

VAR
  Motor AT %QX0.0 : BOOL;
END_VAR
VAR RETAIN
  Hours : INT;
END_VAR

PROGRAM Main LD
RUNG
  | GT IN1:=Hours IN2:=0 | COIL Motor |
END_PROGRAM
'''
# What the unit lets ladderd do; all other lines of the probe are an error.
ALLOWED = {'socket AF_UNIX', 'writes /run/rungboard', f'writes {SLOTS}', 'writes /var/lib/private/rungboard', 'writes /tmp',
           'writes /var/tmp', *('opens /dev/' + it for it in ('null', 'zero', 'full', 'random', 'urandom', 'tty', 'pts/ptmx'))}


def debs(folder):
    return {os.path.basename(path): path for path in glob.glob(folder + '/*.deb')}


def package(name):
    return next(path for it, path in debs(sys.argv[1]).items() if it.startswith(f'rungboard-{name}_') and it.endswith(f'_{ARCH}.deb'))


def install(machine, path, *options):
    shutil.copy(path, machine.path('/root/package.deb'))
    return machine.do('apt-get', 'install', '-y', '--no-install-recommends', *options, '/root/package.deb')


class Desk:
    """A person with a key whom the board lets in as each of @users."""

    def __init__(self, machine, users):
        self.machine = machine
        self.folder = tempfile.mkdtemp()
        run('ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', self.folder + '/key')
        with open(self.folder + '/key.pub', encoding='utf-8') as file:
            key = file.read()
        for user in users:
            os.makedirs(machine.path(f'/home/{user}/.ssh'), exist_ok=True)
            machine.write(f'/home/{user}/.ssh/authorized_keys', key)
            machine.do('chown', '-R', f'{user}:{user}', f'/home/{user}')
        self.write('known', '127.0.0.1 ' + machine.read('/etc/ssh/ssh_host_ed25519_key.pub'))
        self.write('config', f'Host garage\n HostName 127.0.0.1\n HostKeyAlias 127.0.0.1\nHost *\n IdentityFile {self.folder}/key\n IdentitiesOnly yes\n IdentityAgent none\n'
                   f' BatchMode yes\n UserKnownHostsFile {self.folder}/known\n')
        self.ssh = f'ssh -F {self.folder}/config'

    def write(self, name, text):
        with open(self.folder + '/' + name, 'w', encoding='utf-8') as file:
            file.write(text)
        return self.folder + '/' + name

    def program(self, text, name):
        """A program and its map with simulated lines; returns both paths."""
        pins = sorted(set(re.findall(r'AT (%[IQ]X[\d.]+)', text)))
        return self.write(name + '.rung', text), self.write(name + '.io', 'BOARD "garage"\n' + ''.join(f'{pin} sim\n' for pin in pins))

    def ladder(self, *words, cwd=None):
        """Asks again when no answer came in the time that the desk waits: this machine may be busy."""
        return until(lambda: self.asked(words, cwd), 'an answer')

    def asked(self, words, cwd):
        done = subprocess.run([BUILD + '/ladder', *words, '--ssh', self.ssh], text=True, capture_output=True, check=False,
                              stdin=subprocess.DEVNULL, cwd=cwd)
        return None if re.search('LD850|LD022', done.stderr) else done

    def board(self, *words, user='pi'):
        return self.ladder('board', user + '@127.0.0.1', *words)

    def status(self):
        done = self.board('status')
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def push(self, text, name):
        done = self.ladder('push', *self.program(text, name), 'pi@127.0.0.1')
        assert done.returncode == 0 and 'mode: RUN' in done.stdout, done.stdout + done.stderr


def garage():
    with open(HERE + '/ladders/garage-door.rung', encoding='utf-8') as file:
        return file.read()


def users(machine):
    machine.do('useradd', '-m', '-p', '*', 'pi')
    machine.do('useradd', '-m', '-p', '*', 'guest')
    machine.do('usermod', '-aG', 'ladder-eng', 'pi')
    return Desk(machine, ('pi', 'guest'))


def booted(test):
    """A test of a machine of its own."""
    def around():
        machine = Machine(sys.argv[3])
        try:
            test(machine)
        finally:
            machine.end()
    around.__name__ = test.__name__
    return around


def test_the_packages_are_there():
    want = {(name, arch) for name in ('runtime', 'editor') for arch in (os.environ.get('DEB_ARCH') or ' '.join(ARCHES)).split()}
    names = debs(sys.argv[1])
    found = {re.fullmatch(r'rungboard-(runtime|editor)_[\d.]+_(\w+)\.deb', name).groups() for name in names}
    assert found == want, names
    machines = {'amd64': 'X86-64', 'arm64': 'AArch64', 'armhf': 'ARM'}
    with tempfile.TemporaryDirectory() as folder:
        for name, path in names.items():
            run('dpkg-deb', '-x', path, f'{folder}/{name}')
            for program in glob.glob(f'{folder}/{name}/usr/bin/*'):
                with open(program, 'rb') as file:
                    if file.read(4) != b'\x7fELF':
                        continue
                said = run('readelf', '-h', program, text=True, capture_output=True).stdout
                assert re.search(rf'Machine:.*{machines[name.split("_")[2][:-4]]}\n', said), (program, said)


def test_built_twice_they_are_the_same():
    first, again = debs(sys.argv[1]), debs(sys.argv[2])
    assert again and set(again) == set(first), (first, again)
    for name, path in again.items():
        one, two = (hashlib.sha256(open(it, 'rb').read()).hexdigest() for it in (first[name], path))
        assert one == two, name


def test_lintian_has_no_error():
    done = subprocess.run(['lintian', '--allow-root', '--fail-on', 'error', *debs(sys.argv[1]).values()],
                          text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@booted
def test_the_page_of_boards_begins_with_what_works(machine):
    """Runs the first commands of docs/boards.md, as they are there; the lines of the map are simulated."""
    with open(HERE + '/docs/boards.md', encoding='utf-8') as file:
        page = file.read().split('`./run deb`')[0]
    install_it, group, status, push, restart = re.findall(r'^    ([^#\n]*[^#\s])', page, re.M)
    with open(HERE + '/packaging/debian/changelog', encoding='utf-8') as file:
        version = re.match(r'rungboard \((.*?)\)', file.readline()).group(1)
    assert install_it == f'sudo apt install ./rungboard-runtime_{version}_arm64.deb', install_it
    shutil.copy(package('runtime'), machine.path('/root/'))
    machine.do('sh', '-c', 'cd /root && ' + install_it.replace('sudo apt', 'apt-get -y').replace('arm64', ARCH))
    machine.do('dpkg', '--audit')
    for name in ('gpio', 'ladder-view', 'ladder-oper', 'ladder-eng', 'ladder-io'):
        assert f'\n{name}:' in machine.read('/etc/group'), name
    machine.do('useradd', '-m', '-p', '*', 'pi')
    machine.do('useradd', '-m', '-p', '*', 'guest')
    desk = Desk(machine, ('pi', 'guest'))
    assert 'LD805' in desk.board('status').stderr
    machine.do('sh', '-c', group.replace('sudo ', '').replace('$USER', 'pi'))
    with open(desk.folder + '/garage-door.rung', 'w', encoding='utf-8') as file:
        file.write(garage())
    board = machine.read('/usr/share/rungboard/boards/raspberry-pi.io')
    desk.write('raspberry-pi.io', re.sub(r'^(%\S+ +)gpio', r'\1sim', board, flags=re.M))

    def shown(command):
        done = desk.ladder(*command.split()[1:], cwd=desk.folder)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout
    assert 'mode: STOP' in shown(status)
    # Only sshd listens in the network.
    with open('/proc/net/tcp', encoding='utf-8') as file:
        ports = {int(it.split()[1].split(':')[1], 16) for it in file.readlines()[1:] if it.split()[3] == '0A'}
    assert ports == {22}, ports
    assert 'mode: RUN' in shown(push)
    assert desk.board('compare', desk.folder + '/garage-door.rung').returncode == 0
    done = desk.board('status', user='guest')
    assert done.returncode == 1 and 'LD805' in done.stderr, done.stderr
    machine.do('sh', '-c', restart.replace('sudo ', ''))
    assert 'mode: RUN' in shown(status)
    # The offered part of sshd's configuration leaves no shell.
    assert DROP_IN in page
    machine.write('/etc/ssh/sshd_config.d/ladder.conf', machine.read(DROP_IN))
    machine.do('systemctl', 'reload', 'ssh')

    def no_shell():
        """While sshd reads its configuration, it takes no connection."""
        done = subprocess.run([*shlex.split(desk.ssh), 'pi@127.0.0.1', 'echo', 'a shell'], text=True, capture_output=True, check=False,
                              stdin=subprocess.DEVNULL)
        return 'a shell' not in done.stdout and 'ssh: connect to host' not in done.stderr
    until(no_shell, 'no shell')
    assert 'mode: RUN' in shown(status)


@booted
def test_the_editor_connects_and_downloads(machine):
    install(machine, package('runtime'))
    desk = users(machine)
    run('dpkg-deb', '-x', package('editor'), desk.folder + '/desk')
    share = desk.folder + '/desk/usr/share'
    run('glib-compile-schemas', share + '/glib-2.0/schemas')
    program, _ = desk.program(garage(), 'garage-door')
    done = subprocess.run(['/usr/bin/python3', HERE + '/tests/deb/editor.py'], text=True, capture_output=True, check=False, env={
        **os.environ, 'BUILD': BUILD, 'LADDER_EDITOR': desk.folder + '/desk/usr/bin/ladder-editor', 'RUNGBOARD_SSH': desk.ssh,
        'XDG_DATA_DIRS': share + ':/usr/share', 'PROGRAM': program, 'WHERE': 'pi@127.0.0.1'})
    assert done.returncode == 0 and re.search('^ok 1', done.stdout, re.M), done.stdout + done.stderr
    assert 'skip' not in done.stdout.lower(), done.stdout
    assert 'mode: RUN' in desk.status()
    assert desk.board('compare', program).returncode == 0


@booted
def test_the_unit_runs_in_its_sandbox(machine):
    install(machine, package('runtime'))
    desk = users(machine)
    desk.push(garage(), 'garage-door')
    both = machine.says('cat', f'/sys/fs/cgroup{machine.unit("ControlGroup")}/cgroup.procs').split()
    assert len(both) == 2 and machine.unit('MainPID') in both, both
    for process in both:
        confined(machine.says('cat', f'/proc/{process}/status'))
    # The same unit runs the probe, in place of ladder-guard, from whom systemd hears that the unit has started.
    run('cc', '-std=gnu11', '-static', '-o', machine.path('/usr/bin/probe'), HERE + '/tests/deb/probe.c')
    machine.do('mknod', '-m', '666', '/dev/probe-tun', 'c', '10', '200')
    machine.do('sh', '-c', ': </dev/probe-tun')
    machine.do('systemctl', 'stop', 'ladderd')
    os.rename(machine.path('/usr/bin/ladder-guard'), machine.path('/usr/bin/ladder-guard.kept'))
    os.rename(machine.path('/usr/bin/probe'), machine.path('/usr/bin/ladder-guard'))
    begin = len(machine.journal())
    machine.do('systemctl', 'start', 'ladderd')
    said = machine.journal()[begin:]
    confined(said)
    assert re.findall(r'^ *(\w+): *\d+ ', said, re.M) == ['lo'], said
    assert 'processes: 1\n' in said and '/proc/meminfo: ENOENT\n' in said, said
    assert '/dev/probe-tun: EPERM' in said, said
    assert 'execve: EACCES' in said, said
    for call in ('ptrace', 'mount', 'unshare', 'bpf', 'init_module', 'io_uring_setup', 'kill 1', 'memory to write and run'):
        assert f'\n{call}: EPERM\n' in said, (call, said)
    for line in said.split('\n'):
        what = re.match(r'((?:writes|opens) \S+)$|(.*): ok$', line)
        assert not what or (what.group(1) or what.group(2)) in ALLOWED, (line, said)
    for family in ('INET', 'INET6', 'NETLINK', 'PACKET', 'VSOCK'):
        assert f'socket AF_{family}: EAFNOSUPPORT\n' in said, said


def confined(status):
    """/proc/PID/status of a process without rights."""
    for line in (r'Uid:\t[1-9]\d*\t', r'CapEff:\t0+$', r'CapPrm:\t0+$', r'CapBnd:\t0+$', r'CapAmb:\t0+$', r'NoNewPrivs:\t1$',
                 r'Seccomp:\t2$'):
        assert re.search('^' + line, status, re.M), (line, status)


def older(folder, **changes):
    """The runtime as an older version: other contents of some of its files."""
    tree = folder + '/tree'
    run('dpkg-deb', '-R', package('runtime'), tree)
    for path in (tree + '/DEBIAN/control', *(tree + it for it in changes['files'])):
        with open(path, encoding='utf-8') as file:
            text = file.read()
        with open(path, 'w', encoding='utf-8') as file:
            file.write(re.sub(r'^Version: .*', 'Version: 0.0.1', text, flags=re.M) if path.endswith('control') else text + '# of old\n')
    run('sh', '-c', 'cd "$1" && find * -path DEBIAN -prune -o -type f -print0 | xargs -0 md5sum >DEBIAN/md5sums', 'sh', tree)
    run('dpkg-deb', '--root-owner-group', '-b', tree, folder + '/older.deb', stdout=subprocess.DEVNULL)
    return folder + '/older.deb'


@booted
def test_an_upgrade_keeps_all_and_stops_nothing(machine):
    before = machine.everything()
    with tempfile.TemporaryDirectory() as folder:
        install(machine, older(folder, files=[CONFIG, '/usr/bin/ladderd-run']))
    desk = users(machine)
    old = machine.read(CONFIG)
    assert old.endswith('# of old\n') and '# of old' in machine.read('/usr/bin/ladderd-run')
    # What a person changes: the options, so that the journal shows each change of an output.
    machine.write(CONFIG, old.replace('--period 10ms', '--period 20ms --trace-io'))
    machine.do('systemctl', 'restart', 'ladderd')
    desk.push(KEEPS, 'keeps')
    done = desk.board('set', 'Hours=7')
    assert done.returncode == 0, done.stdout + done.stderr
    until(lambda: '%QX0.0 1' in machine.journal(), 'the output')
    process = machine.unit('MainPID')
    said = install(machine, package('runtime'), '-o', 'Dpkg::Options::=--force-confdef', '-o', 'Dpkg::Options::=--force-confold')
    assert 'ladderd goes on with the version before' in said.stdout, said.stdout
    assert machine.unit('MainPID') == process and 'mode: RUN' in desk.status(), (process, said.stdout, desk.status(), machine.journal())
    assert '%QX0.0 0' not in machine.journal()
    assert '# of old' not in machine.read('/usr/bin/ladderd-run')
    assert '--trace-io' in machine.read(CONFIG) and '# of old' not in machine.read(CONFIG + '.dpkg-dist')
    # The restart, when a person wants it: outputs are safe, then the program goes on with what it keeps.
    machine.do('systemctl', 'restart', 'ladderd')
    assert machine.unit('MainPID') != process
    until(lambda: machine.journal().count('%QX0.0 1') == 2, 'the output')
    assert re.search(r'%QX0.0 1\n(?s:.*)%QX0.0 0\n(?s:.*)%QX0.0 1', machine.journal()), machine.journal()
    assert 'period: 20000' in desk.status(), desk.status()
    assert '7' in desk.board('get', 'Hours').stdout
    # A machine that a person has stopped stays stopped.
    machine.do('systemctl', 'stop', 'ladderd')
    install(machine, package('runtime'), '--reinstall')
    assert machine.unit('ActiveState') == 'inactive', 'the upgrade started the machine'
    removed(machine, desk)
    purged(machine, before)


def removed(machine, desk):
    """A remove makes the outputs safe and keeps configuration and program; after it is installed again, the program runs."""
    machine.do('systemctl', 'start', 'ladderd')
    until(lambda: machine.journal().count('%QX0.0 1') == 3, 'the output')
    machine.do('apt-get', 'remove', '-y', 'rungboard-runtime')
    assert machine.journal().count('%QX0.0 0') == 3, machine.journal()
    machine.do('test', '!', '-e', '/run/rungboard/link', '-a', '!', '-e', '/usr/bin/ladderd')
    assert '--trace-io' in machine.read(CONFIG)
    assert os.path.exists(machine.path('/var/lib/private/rungboard/prog.A'))
    install(machine, package('runtime'))
    assert 'mode: RUN' in desk.status()
    assert '7' in desk.board('get', 'Hours').stdout


def purged(machine, before):
    machine.do('apt-get', 'purge', '-y', 'rungboard-runtime')
    left = {path for path in machine.everything() - before if re.search('rung|ladder', path)}
    assert all(path.startswith('./home/') for path in left), left
    # Files may belong to the groups.
    assert '\nladder-eng:' in machine.read('/etc/group')
    assert 'ladderd' not in machine.says('systemctl', 'list-units', '--all', '--no-pager', '--plain')


def main():
    tests = [it for name, it in globals().items() if name.startswith('test_') and (not sys.argv[5:] or name in sys.argv[5:])]
    print(f'1..{len(tests)}', flush=True)
    failed = 0
    for number, test in enumerate(tests, 1):
        name = test.__name__[5:].replace('_', ' ')
        try:
            test()
            print(f'ok {number} - {name}', flush=True)
        except Exception:  # pylint: disable=broad-except
            failed = 1
            print(f'not ok {number} - {name}')
            print(''.join('# ' + line + '\n' for line in traceback.format_exc().splitlines()), flush=True)
    return failed


if __name__ == '__main__':
    if sys.argv[4:5] != ['inside']:
        os.execvp('unshare', ['unshare', '--mount', '--net', '--pid', '--fork', '--kill-child', '--mount-proc', 'sh', '-c',
                              'ip link set lo up; exec "$@"', 'sh', sys.executable, *sys.argv[:4], 'inside', *sys.argv[4:]])
    sys.exit(main())
