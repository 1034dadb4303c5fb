# SPDX-License-Identifier: MIT
"""machine - a Debian with systemd, in a folder, that boots as a container in the network of the caller."""
import os
import signal
import subprocess
import tempfile
import time

ENVIRONMENT = {'PATH': '/usr/sbin:/usr/bin:/sbin:/bin', 'LC_ALL': 'C.UTF-8', 'DEBIAN_FRONTEND': 'noninteractive'}


def run(*words, **options):
    return subprocess.run(words, check=True, **options)


def until(check, what='it'):
    """Waits until check() returns something true, and returns it."""
    for _ in range(1200):
        value = check()
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError(f'{what} did not happen')


class Machine:
    """A copy of @tar, booted. Needs root and systemd-nspawn."""

    def __init__(self, tar):
        self.root = tempfile.mkdtemp()
        # A disk in memory: dpkg waits for each file to be on it.
        run('mount', '-t', 'tmpfs', '-o', 'mode=755', 'machine', self.root)
        run('tar', '-xf', tar, '-C', self.root)
        self.console = open(self.root + '.log', 'w', encoding='utf-8')
        # The limits of devices are a BPF program of a group in the unified hierarchy.
        self.boot = subprocess.Popen(
            ['systemd-nspawn', '--quiet', '--boot', '--register=no', '--keep-unit', '--capability=all', '--resolv-conf=off', '--machine=board', '-D', self.root],
            stdin=subprocess.DEVNULL, stdout=self.console, stderr=self.console,
            env={**os.environ, 'SYSTEMD_NSPAWN_UNIFIED_HIERARCHY': '1', 'SYSTEMD_SECCOMP': '0'})
        self.init = until(self.first, 'the boot')
        until(lambda: self.do('systemctl', 'is-system-running', good=False).stdout.strip() in ('running', 'degraded'), 'the boot')

    def first(self):
        """The number of its first process, for us."""
        assert self.boot.poll() is None, self.log()
        found = subprocess.run(['pgrep', '-P', str(self.boot.pid)], text=True, capture_output=True, check=False).stdout.split()
        for pid in found:
            try:
                if os.path.basename(os.readlink(f'/proc/{pid}/exe')) == 'systemd':
                    return pid
            except FileNotFoundError:
                pass  # it has ended
        return None

    def log(self):
        with open(self.root + '.log', encoding='utf-8', errors='replace') as file:
            return file.read()

    def path(self, name):
        return self.root + name

    def read(self, name):
        with open(self.path(name), encoding='utf-8') as file:
            return file.read()

    def write(self, name, text):
        with open(self.path(name), 'w', encoding='utf-8') as file:
            file.write(text)

    def do(self, *words, good=True):
        done = subprocess.run(['nsenter', '-t', self.init, '--all', '--', *words], text=True, capture_output=True, env=ENVIRONMENT,
                              stdin=subprocess.DEVNULL, timeout=600, check=False)
        assert not good or done.returncode == 0, f'{words}\n{done.stdout}{done.stderr}'
        return done

    def says(self, *words):
        return self.do(*words).stdout.strip()

    def unit(self, name):
        """A property of the unit of ladderd."""
        return self.says('systemctl', 'show', '--value', '-p', name, 'ladderd')

    def journal(self):
        self.do('journalctl', '--sync')
        return self.says('journalctl', '-u', 'ladderd', '-o', 'cat', '--no-pager')

    def everything(self):
        """All paths of its disk."""
        found = run('find', '.', '-xdev', '-print', cwd=self.root, text=True, capture_output=True).stdout
        return set(found.split('\n'))

    def end(self):
        self.boot.send_signal(signal.SIGTERM)
        try:
            self.boot.wait(60)
        except subprocess.TimeoutExpired:
            self.boot.kill()
            self.boot.wait()
        self.console.close()
        run('umount', '-l', self.root)
        os.rmdir(self.root)
        os.unlink(self.root + '.log')
