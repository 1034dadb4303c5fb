# SPDX-License-Identifier: MIT
"""screen - a desk without a program: a private X screen, a window manager, a session bus, a home folder.

finder.py and desk.py use it.
"""
import ctypes
import os
import re
import shutil
import subprocess
import tempfile
import time

from node import Gone

try:
    import dbus.bus
    import dbus.exceptions
    import dbus.lowlevel
except ImportError:
    dbus = None
PATIENCE = int(os.environ.get('PATIENCE', '60'))  # seconds until a condition must hold
TOOLS = ('Xvfb', 'openbox', 'xdotool', 'xwininfo', 'xprop', 'xclip', 'import', 'dbus-daemon', 'dbus-monitor')
BUS_LAUNCHERS = ('/usr/libexec/at-spi-bus-launcher', '/usr/lib/at-spi2-core/at-spi-bus-launcher')


def lacking():
    """The names of missing programs."""
    lacks = [tool for tool in TOOLS if not shutil.which(tool)]
    if not any(os.path.exists(path) for path in BUS_LAUNCHERS):
        lacks.append('at-spi2-core')
    return lacks + ([] if dbus else ['python3-dbus'])


def sh(*args, **more):
    return subprocess.run(args, capture_output=True, text=True, timeout=60, **more).stdout.strip()


def until(look, what, seconds=PATIENCE):
    """Waits until look() returns something true, and returns it. A widget that is gone counts as nothing. It pauses
    twice as long as a look takes: the editor answers it, and has something else to do."""
    end = time.monotonic() + seconds
    while True:
        begin = time.monotonic()
        try:
            value = look()
        except Gone:
            value = None
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError('it did not come: ' + what)
        time.sleep(max(0.06, 2 * (time.monotonic() - begin)))


def urge(look, act, what, pause=5, wait=0):
    """Acts until look() returns something true, and returns it. After each act it waits @pause seconds for that: one act
    too many would disturb what is coming. A second click, for example, would make it a double click. @wait: seconds
    before the first act."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            return until(look, what, wait)
        except AssertionError:
            if time.monotonic() > end:
                raise
        try:
            act()
            wait = pause
        except Gone:  # it did nothing
            wait = 0.06


def is_gone(pid):
    """Has a process ended, whoever waits for it?"""
    try:
        with open('/proc/%d/stat' % pid) as stat:
            return stat.read().rsplit(')', 1)[1].split()[0] == 'Z'
    except FileNotFoundError:
        return True


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent, padded to an XEvent."""
    _fields_ = [('type', ctypes.c_int), ('serial', ctypes.c_ulong), ('sent', ctypes.c_int),
                ('display', ctypes.c_void_p), ('window', ctypes.c_ulong), ('message', ctypes.c_ulong),
                ('format', ctypes.c_int), ('data', ctypes.c_long * 5), ('rest', ctypes.c_long * 12)]


def open_display():
    """The X library and a connection to the screen."""
    x = ctypes.CDLL('libX11.so.6')
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XDefaultRootWindow.restype = x.XInternAtom.restype = ctypes.c_ulong
    return x, ctypes.c_void_p(x.XOpenDisplay(None))


def empty_clipboard():
    x, display = open_display()
    clipboard = x.XInternAtom(display, b'CLIPBOARD', 0)
    x.XSetSelectionOwner(display, ctypes.c_ulong(clipboard), ctypes.c_ulong(0), ctypes.c_ulong(0))
    x.XCloseDisplay(display)


def close_window(window):
    """Closes a window as a task bar does: asks the window manager to (_NET_CLOSE_WINDOW of the EWMH)."""
    x, display = open_display()
    message = x.XInternAtom(display, b'_NET_CLOSE_WINDOW', 0)
    event = ClientMessage(type=33, window=window, message=message, format=32)  # ClientMessage
    event.data[1] = 2  # 2: by a pager or task bar, not by the program
    redirect = 1 << 19 | 1 << 20  # SubstructureNotifyMask, SubstructureRedirectMask
    x.XSendEvent(display, ctypes.c_ulong(x.XDefaultRootWindow(display)), 0, redirect, ctypes.byref(event))
    x.XCloseDisplay(display)


class Focus:
    """Which program gets the keys."""

    def __init__(self):
        self.x, self.display = open_display()

    def program(self):
        """A number for it; 0 for none. An X server gives each program a range of 2^21 numbers for its windows."""
        window, revert = ctypes.c_ulong(), ctypes.c_int()
        self.x.XGetInputFocus(self.display, ctypes.byref(window), ctypes.byref(revert))
        return window.value >> 21


def pixels(x, y, width, height):
    """The colours of an area of the screen, line by line."""
    picture = subprocess.run(['import', '-window', 'root', '-crop', '%dx%d+%d+%d' % (width, height, x, y),
                              '-depth', '8', 'ppm:-'], capture_output=True, check=True).stdout
    body = picture[len(re.match(rb'P6\s+\d+\s+\d+\s+\d+\s', picture)[0]):]
    return [tuple(body[i:i + 3]) for i in range(0, len(body), 3)]


def pointer_name():
    """The name of the shape that the pointer has; '': a shape without a name."""
    class Image(ctypes.Structure):
        _fields_ = [('x', ctypes.c_short), ('y', ctypes.c_short), ('width', ctypes.c_ushort), ('height', ctypes.c_ushort),
                    ('xhot', ctypes.c_ushort), ('yhot', ctypes.c_ushort), ('serial', ctypes.c_ulong),
                    ('pixels', ctypes.c_void_p), ('atom', ctypes.c_ulong), ('name', ctypes.c_char_p)]
    x, display = open_display()
    fixes = ctypes.CDLL('libXfixes.so.3')
    fixes.XFixesGetCursorImage.restype, fixes.XFixesGetCursorImage.argtypes = ctypes.POINTER(Image), [ctypes.c_void_p]
    fixes.XFixesQueryExtension.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_int), ctypes.POINTER(ctypes.c_int)]
    fixes.XFixesQueryExtension(display, ctypes.byref(ctypes.c_int()), ctypes.byref(ctypes.c_int()))
    name = fixes.XFixesGetCursorImage(display).contents.name.decode()
    x.XCloseDisplay(display)
    return name


class Screen:
    """A private X screen with a window manager, a session bus, a home folder."""

    def __init__(self, size='1440x900x24'):
        self.runtime = tempfile.mkdtemp(prefix='rungboard-run-')
        self.running, self.size = [], size
        os.environ.update(XDG_RUNTIME_DIR=self.runtime, LC_ALL='C.UTF-8', LANGUAGE='',
                          GDK_BACKEND='x11', GSK_RENDERER='cairo', GTK_A11Y='atspi',
                          GSETTINGS_BACKEND='memory', ADW_DISABLE_PORTAL='1', GTK_USE_PORTAL='0', NO_AT_BRIDGE='0')
        os.environ.pop('XDG_DATA_HOME', None)
        os.environ.pop('DISPLAY', None)  # of the last test: the session bus starts programs with it
        self.move_in()
        self.start_bus()
        read, write = os.pipe()
        # -r: no key repeats while a busy machine is late to release it.
        self.start('Xvfb', '-displayfd', str(write), '-screen', '0', size, '-nolisten', 'tcp', '-noreset', '-r',
                   pass_fds=[write])
        os.close(write)
        number = b''
        while not number.endswith(b'\n'):
            number += os.read(read, 16)
        os.environ['DISPLAY'] = ':' + number.decode().strip()
        self.start('openbox', '--sm-disable')
        if shutil.which('xcompmgr'):  # without it popovers have a black frame
            self.start('xcompmgr')
        until(self.is_managed, 'the window manager')
        self.always = len(self.running)
        self.manager = Focus().program()  # no other program has a window yet

    def move_in(self):
        """A new home folder."""
        self.home = tempfile.mkdtemp(prefix='rungboard-desk-')
        os.environ.update(HOME=self.home, XDG_STATE_HOME=os.path.join(self.home, 'state'))

    def tidy(self):
        """Resets the screen for the next test: a new home folder, an empty clipboard, the pointer in the middle."""
        shutil.rmtree(self.home, ignore_errors=True)
        self.move_in()
        empty_clipboard()
        sh('xdotool', 'mousemove', '--polar', '0', '0')

    @staticmethod
    def is_managed():
        """The window manager answers. Openbox 3.6 announces itself before it is ready and reads earlier messages
        only when another one arrives, so a window would wait for ever; a question is one more message."""
        if 'window id' not in sh('xprop', '-root', '_NET_SUPPORTING_WM_CHECK'):
            return False
        sh('xdotool', 'set_num_desktops', '1')
        return sh('xdotool', 'get_num_desktops') == '1'

    @staticmethod
    def accessibility_address():
        session = dbus.bus.BusConnection(os.environ['DBUS_SESSION_BUS_ADDRESS'])
        return session.call_blocking('org.a11y.Bus', '/org/a11y/bus', 'org.a11y.Bus', 'GetAddress', '', ())

    def accessibility(self):
        """A new connection to the accessibility bus."""
        return dbus.bus.BusConnection(self.accessibility_address())

    def start_bus(self):
        bus = subprocess.Popen(['dbus-daemon', '--session', '--nofork', '--print-address=1'],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.running.append(bus)
        os.environ['DBUS_SESSION_BUS_ADDRESS'] = bus.stdout.readline().strip()

    def start(self, *args, **more):
        """Starts another program, without the environment for strict memory: with it openbox allows no drag."""
        env = {name: value for name, value in os.environ.items() if name != 'G_SLICE'}
        self.running.append(subprocess.Popen(args, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more))

    def told(self):
        """The open windows, for the log of a failure."""
        # A test has its own process, which cannot wait for programs of its parent.
        ended = [process.args[0] + ' has ended' for process in self.running if is_gone(process.pid)]
        tree = sh('xwininfo', '-root', '-tree').splitlines()
        return ended + [sh('xprop', '-root', '_NET_CLIENT_LIST'),
                        *(line for line in tree if '+' in line and ' 1x1+' not in line)]

    def end(self, but=0):
        """Ends all programs except the first ones."""
        while len(self.running) > but:
            process = self.running.pop()
            process.kill()
            process.wait()

    def close(self):
        self.end()
        for folder in self.home, self.runtime:
            shutil.rmtree(folder, ignore_errors=True)
