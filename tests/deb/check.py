#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""check - tests the packages of Debian: check.py DEBS AGAIN ROOT

DEBS and AGAIN are folders with the same packages, built twice; ROOT is a tar file of a Debian with
openssh-server and systemd, into which nothing of Rungboard was installed. Needs root: it installs into a
copy of that system, with a network of its own, and connects to its sshd as a desk would.
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
import time
import traceback

HERE = os.path.abspath(os.path.dirname(__file__) + '/../..')
BUILD = os.path.abspath(os.environ.get('BUILD', 'build'))
ARCH = subprocess.run(['dpkg', '--print-architecture'], text=True, capture_output=True, check=True).stdout.strip()
MAP = 'BOARD "garage"\n'
ENVIRONMENT = {'PATH': '/usr/sbin:/usr/bin:/sbin:/bin', 'LC_ALL': 'C.UTF-8', 'DEBIAN_FRONTEND': 'noninteractive'}


class Machine:
    """A copy of ROOT in a folder."""

    def __init__(self, tar):
        self.root = tempfile.mkdtemp()
        self.started = []
        run('tar', '-xf', tar, '-C', self.root)
        run('mount', '-t', 'proc', 'proc', self.root + '/proc')
        run('mount', '--rbind', '/dev', self.root + '/dev')
        os.makedirs(self.root + '/run/sshd', exist_ok=True)

    def path(self, name):
        return self.root + name

    def read(self, name):
        with open(self.path(name), encoding='utf-8') as file:
            return file.read()

    def write(self, name, text):
        with open(self.path(name), 'w', encoding='utf-8') as file:
            file.write(text)

    def do(self, *words, good=True):
        done = subprocess.run(['chroot', self.root, *words], text=True, capture_output=True, env=ENVIRONMENT,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        assert not good or done.returncode == 0, f'{words}\n{done.stdout}{done.stderr}'
        return done

    def start(self, *words, user=None):
        with open(self.path('/tmp/log'), 'a', encoding='utf-8') as log:
            child = subprocess.Popen(['chroot', *(['--userspec', f'{user}:{user}'] if user else []), self.root, *words],
                                     stdout=log, stderr=log, stdin=subprocess.DEVNULL, env=ENVIRONMENT)
        self.started.append(child)
        return child

    def end(self):
        for child in reversed(self.started):
            child.terminate()
            child.wait(30)
        run('umount', '-l', self.root + '/dev', self.root + '/proc')
        shutil.rmtree(self.root)


def run(*words, **options):
    return subprocess.run(words, check=True, **options)


def until(check):
    for _ in range(600):
        if check():
            return
        time.sleep(0.05)
    raise AssertionError('it did not happen')


def of_unit(machine):
    """The command of the unit, as systemd splits it."""
    unit = machine.read('/lib/systemd/system/ladderd.service')
    names = {'LADDERD_FILE': '', 'LADDERD_MAP': ''}
    for path in re.findall(r'^EnvironmentFile=-?(.*)$', unit, re.M):
        if os.path.exists(machine.path(path)):
            names.update(re.findall(r'^(\w+)="?([^"\n]*)"?$', machine.read(path), re.M))
    words = []
    for word in re.search(r'^ExecStart=(.*)$', unit, re.M).group(1).split():
        if re.fullmatch(r'\$\w+', word):
            words += shlex.split(names[word[1:]])
        else:
            words.append(re.sub(r'\$\{(\w+)\}', lambda it: names[it.group(1)], word))
    return words


def debs(folder):
    return {os.path.basename(path): path for path in glob.glob(folder + '/*.deb')}


def test_the_packages_are_there():
    names = debs(sys.argv[1])
    assert names, 'no package'
    for name in names:
        assert re.fullmatch(r'rungboard-(runtime|editor)_[\d.]+_(amd64|arm64|armhf)\.deb', name), name
    assert any(name.startswith('rungboard-runtime') and ARCH in name for name in names), names


def test_built_twice_they_are_the_same():
    first, again = debs(sys.argv[1]), debs(sys.argv[2])
    assert again and set(again) <= set(first), (first, again)
    for name, path in again.items():
        one, two = (hashlib.sha256(open(it, 'rb').read()).hexdigest() for it in (first[name], path))
        assert one == two, name


def test_lintian_has_no_error():
    done = subprocess.run(['lintian', '--allow-root', '--fail-on', 'error', *debs(sys.argv[1]).values()],
                          text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_desk_connects_and_downloads():
    machine = Machine(sys.argv[3])
    try:
        package = [path for name, path in debs(sys.argv[1]).items() if name.startswith('rungboard-runtime') and ARCH in name][0]
        before = everything(machine)
        shutil.copy(package, machine.path('/tmp/package.deb'))
        machine.do('apt-get', 'install', '-y', '--no-install-recommends', '/tmp/package.deb')
        for group in ('gpio', 'ladder-view', 'ladder-oper', 'ladder-eng'):
            assert f'\n{group}:' in machine.read('/etc/group'), group
        machine.do('dpkg', '--audit')
        machine.do('useradd', '-m', '-p', '*', '-G', 'ladder-eng', 'pi')
        machine.do('useradd', '-m', '-p', '*', 'guest')
        board(machine)
        again(machine)
        gone(machine, before)
    finally:
        machine.end()


def everything(machine):
    done = run('find', '.', '-xdev', '-path', './proc', '-prune', '-o', '-path', './dev', '-prune', '-o', '-print',
               cwd=machine.root, text=True, capture_output=True)
    return set(done.stdout.split('\n'))


def board(machine):
    """The service runs, and a desk puts the garage door there."""
    os.makedirs(machine.path('/var/lib/rungboard'), exist_ok=True)
    os.makedirs(machine.path('/run/rungboard'), exist_ok=True)
    for folder in ('/var/lib/rungboard', '/run/rungboard'):
        os.chown(machine.path(folder), 61234, 61234)
    daemon = machine.start(*of_unit(machine), user=61234)
    until(lambda: os.path.exists(machine.path('/run/rungboard/link')) or daemon.poll() is not None)
    assert daemon.poll() is None, machine.read('/tmp/log')
    with tempfile.TemporaryDirectory() as desk:
        run('ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-f', desk + '/key')
        key = open(desk + '/key.pub', encoding='utf-8').read()
        for user in ('pi', 'guest'):
            os.makedirs(machine.path(f'/home/{user}/.ssh'), exist_ok=True)
            machine.write(f'/home/{user}/.ssh/authorized_keys', key)
            machine.do('chown', '-R', f'{user}:{user}', f'/home/{user}')
        machine.do('ssh-keygen', '-A')
        server = machine.start('/usr/sbin/sshd', '-D', '-p', '2222', '-o', 'UsePAM=no')
        host = machine.read('/etc/ssh/ssh_host_ed25519_key.pub')
        with open(desk + '/known', 'w', encoding='utf-8') as file:
            file.write('[127.0.0.1]:2222 ' + host)
        ssh = f'ssh -F none -p 2222 -i {desk}/key -o BatchMode=yes -o IdentityAgent=none -o UserKnownHostsFile={desk}/known'
        program = HERE + '/ladders/garage-door.rung'
        with open(program, encoding='utf-8') as file:
            lines = sorted(set(re.findall(r'AT (%[IQ]X[\d.]+)', file.read())))
        with open(desk + '/board.io', 'w', encoding='utf-8') as file:
            file.write(MAP + ''.join(f'{line} sim\n' for line in lines))

        def ladder(*words):
            return subprocess.run([BUILD + '/ladder', *words, '--ssh', ssh], text=True, capture_output=True, check=False,
                                  stdin=subprocess.DEVNULL)
        until(lambda: ladder('board', 'pi@127.0.0.1', 'status').returncode == 0)
        done = ladder('board', 'pi@127.0.0.1', 'status')
        assert 'mode: STOP' in done.stdout, done.stdout + done.stderr
        done = ladder('push', program, desk + '/board.io', 'pi@127.0.0.1')
        assert done.returncode == 0 and 'mode: RUN' in done.stdout, done.stdout + done.stderr
        assert 'LD022' not in done.stderr, done.stderr
        assert ladder('board', 'pi@127.0.0.1', 'compare', program).returncode == 0
        done = ladder('board', 'guest@127.0.0.1', 'status')
        assert done.returncode == 1 and 'LD805' in done.stderr, done.stderr
        # Only sshd listens in the network.
        with open('/proc/net/tcp', encoding='utf-8') as file:
            ports = {int(it.split()[1].split(':')[1], 16) for it in file.readlines()[1:] if it.split()[3] == '0A'}
        assert ports == {2222}, ports
        drop_in(machine, server, ssh, ladder)
    daemon.terminate()
    daemon.wait(30)


def drop_in(machine, server, ssh, ladder):
    """The offered part of sshd's configuration: ladderd, and no shell."""
    server.terminate()
    server.wait(30)
    name = '/usr/share/doc/rungboard-runtime/examples/sshd-ladder.conf'
    machine.write('/etc/ssh/sshd_config.d/ladder.conf', machine.read(name))
    machine.do('/usr/sbin/sshd', '-t')
    machine.start('/usr/sbin/sshd', '-D', '-p', '2222', '-o', 'UsePAM=no')
    until(lambda: ladder('board', 'pi@127.0.0.1', 'status').returncode == 0)
    done = subprocess.run([*shlex.split(ssh), 'pi@127.0.0.1', 'echo', 'a shell'], text=True, capture_output=True, check=False,
                          stdin=subprocess.DEVNULL)
    assert 'a shell' not in done.stdout, done.stdout
    os.unlink(machine.path('/etc/ssh/sshd_config.d/ladder.conf'))


def again(machine):
    """An upgrade keeps what a person has changed, and the program."""
    machine.write('/etc/default/ladderd', machine.read('/etc/default/ladderd') + '# mine\n')
    machine.do('apt-get', 'install', '-y', '--reinstall', '--no-install-recommends', '/tmp/package.deb')
    machine.do('dpkg-reconfigure', 'rungboard-runtime')
    assert '# mine' in machine.read('/etc/default/ladderd')
    assert os.path.exists(machine.path('/var/lib/rungboard/prog.A'))


def gone(machine, before):
    machine.do('apt-get', 'remove', '-y', 'rungboard-runtime')
    assert '# mine' in machine.read('/etc/default/ladderd'), 'a remove keeps the configuration'
    assert os.path.exists(machine.path('/var/lib/rungboard/prog.A')), 'and the program'
    machine.do('apt-get', 'purge', '-y', 'rungboard-runtime')
    left = [path for path in everything(machine) - before if re.search('rung|ladder', path)]
    assert all(it.startswith(('./run/', './home/')) for it in left), left


def main():
    tests = [it for name, it in globals().items() if name.startswith('test_')]
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
    if len(sys.argv) == 4:
        os.execvp('unshare', ['unshare', '--mount', '--net', '--pid', '--fork', '--kill-child', '--mount-proc', 'sh', '-c',
                              'ip link set lo up; exec "$@"', 'sh', sys.executable, *sys.argv, 'inside'])
    sys.exit(main())
