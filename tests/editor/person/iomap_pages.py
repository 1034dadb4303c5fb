#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""iomap_pages - a person edits the pages of an I/O map: analog values, Modbus, boards, buses, what others may ask."""
import os
import re
import socket
import sys
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import BUILD, Chinese, Editor, main, until  # noqa: E402
from languages import Foreign  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR_GLOBAL
  Start   AT %IX0.0  : BOOL;
  Level   AT %AIW0   : INT;
  Heat    AT %AIW2   : INT;
  Valve   AT %QX40.0 : BOOL;
  Speed   AT %IW100  : INT;
  Flow    AT %IW104  : INT;
  Running AT %QX0.0  : BOOL;
  Setting AT %AQW0   : INT;
  Door    AT %XIX0.2 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | [ Level > 5000 ] | COIL Running |
RUNG
  | NO Door | COIL Valve |
RUNG
  | [ Heat + Speed > Flow ] | COIL %QX0.1 |
RUNG
  | [ Level > Setting ] | COIL %QX0.2 |
END_PROGRAM
'''

MAP = '''BOARD "Main cabinet"
BUS   rs485  modbus-rtu  port=/dev/ttyS1 baud=19200 parity=even timeout=100ms
BUS   plant  modbus-tcp  host=10.0.0.20:502 timeout=300ms
BUS   yard   peer        interface=eth0
MODULE Card  di=16 dq=8 ai=2 aq=1  discrete-input=100

%IX0.0      gpio    line=GPIO17  pull-up active-low debounce=5ms
%QX0.0      sim     safe=0
%AIW0       iio     device=ads1115 channel=voltage0  range=0..27648 at 0V..10V  filter=50ms   # the tank
%AIW2       w1      sensor=28-000005e2fdc3
%AQW0       pwm     chip=pwmchip0 channel=0 period=20ms safe=0
%XIB0..2    module  bus=rs485 unit=1 type=DIO1000 safe=0
%IW100..106 modbus  bus=plant unit=1 input-register=0 poll=100ms stale=1s substitute=0
%QX40.0     modbus  bus=plant unit=1 coil=16 refresh=5s safe=0
%IW120      peer    from=pump-house name=Level stale=2s
SERVE   plc  modbus-tcp  listen=127.0.0.1:1502 connections=2
WINDOW  plc  coil=0..15            %QX0.0  read-only
WINDOW  plc  holding-register=0..9 %MW0    read-write
PUBLISH main Level, Running every=100ms
'''
PAGES = ['Pins (2)', 'Analog (3)', 'Modbus and modules (3)', 'Other boards (1)', 'Buses (4)', 'What others may ask (4)']


def plant(screen, text=MAP):
    """A project with a map, in its own folder; returns the paths of both."""
    path, io = os.path.join(screen.home, 'plant.rung'), os.path.join(screen.home, 'plant.io')
    for file, what in (path, PROGRAM), (io, text):
        with open(file, 'w') as out:
            out.write(what)
    return path, io


def open_map(editor):
    editor.find('plant.io', 'label')
    editor.click(min(editor.all('plant.io', 'label'), key=lambda node: node.box()[0]), count=2)
    editor.find('Name of the board')


def cell(editor, name):
    return editor.find(name, 'text')


def shows(editor, name, value):
    until(lambda: cell(editor, name).text() == value, '%s to be "%s"' % (name, value))


def saved(editor, io, text):
    editor.keys('ctrl+s')
    until(lambda: open(io).read() == text, 'the map to be saved')


def put(editor, name, value):
    editor.click(cell(editor, name))
    editor.keys('ctrl+a')
    editor.type(value)
    editor.keys('Return')
    shows(editor, name, value)


def pages(screen):
    """each page shows its lines; a cell is edited on each, and only its bytes change"""
    path, io = plant(screen)
    editor = Editor(screen, path)
    open_map(editor)
    for number, (page, name, value) in enumerate([
            ('Pins (2)', '%IX0.0, Debounce', '7ms'), ('Analog (3)', '%AIW0, Range', '0..27648 at 0V..5V'),
            ('Modbus and modules (3)', '%QX40.0, Number', '17'), ('Other boards (1)', '%IW120, Variable', 'Depth'),
            ('Buses (4)', 'plant, Host', '10.0.0.21'), ('What others may ask (4)', 'main, Variables', 'Level')]):
        editor.tab(page)
        cell(editor, name)
        editor.shot('pages-%d' % number)
        put(editor, name, value)
    assert not editor.all(', Value:')
    saved(editor, io, MAP.replace('debounce=5ms', 'debounce=7ms').replace('0V..10V ', '0V..5V  ').replace('coil=16', 'coil=17')
          .replace('name=Level', 'name=Depth').replace('10.0.0.20:502', '10.0.0.21').replace('Level, Running every', 'Level every'))


def lines(screen):
    """lines are added with the next address, bus and number, moved, and follow their driver to its page; errors are counted"""
    path, io = plant(screen)
    editor = Editor(screen, path)
    open_map(editor)
    editor.tab('Modbus and modules (3)')
    editor.click(cell(editor, '%QX40.0, Number'))
    editor.click(editor.find('Add a line', 'push button'))
    editor.focus_on('%QX0.1, Address', 'text')
    shows(editor, '%QX0.1, Number', '17')
    shows(editor, '%QX0.1, Bus', 'plant')
    added = MAP.replace('safe=0\n%IW120', 'safe=0\n%QX0.1  modbus  bus=plant unit=1 coil=17  safe=0\n%IW120')
    saved(editor, io, added)
    editor.keys('ctrl+shift+Up')
    moved = MAP.replace('%QX40.0', '%QX0.1  modbus  bus=plant unit=1 coil=17  safe=0\n%QX40.0')
    saved(editor, io, moved)
    editor.click(editor.find('Move the line down', 'push button'))
    saved(editor, io, added)
    put(editor, '%QX0.1, Number', '16')
    editor.tab('Modbus and modules (4), errors: 1')
    editor.shot('pages-wrong')
    put(editor, '%QX0.1, Number', '18')
    editor.tab('Modbus and modules (4)')
    editor.click(cell(editor, '%QX0.1, Driver'))
    editor.keys('ctrl+a')
    editor.type('sim')
    editor.keys('Return')
    editor.focus_on('%QX0.1, Driver', 'text')
    editor.tab('Pins (3), errors: 1')
    editor.keys('ctrl+z')
    editor.tab('What others may ask (4)')
    editor.click(editor.find('Add another kind of line'))
    editor.find('Add a window of a server', 'menu item').press()
    editor.focus_on('%QX2.0, Name or address', 'text')
    shows(editor, '%QX2.0, Numbers', '16..23')


def values(screen):
    """while the program is simulated each point shows its value; one is forced, set and released from the table"""
    path, _ = plant(screen)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+t')
    editor.says('PAUSE')
    open_map(editor)
    editor.tab('Analog (3)')
    editor.click(editor.find('%AIW0, Value: 0', 'push button'))
    editor.focus_on(role='text')
    editor.keys('ctrl+a')
    editor.type('70000')
    editor.keys('Return')
    editor.find('"70000": constant is out of range')
    editor.keys('ctrl+a')
    editor.type('7000')
    shows(editor, 'New value', '7000')
    editor.find('Force', 'push button').press()
    editor.find('%AIW0, Value: 7000, forced')
    editor.shot('pages-test')
    editor.find('Release force', 'push button').press()
    until(lambda: not editor.all('%AIW0, Value: 7000, forced'), 'the force to be gone')
    editor.keys('Escape')
    until(lambda: not editor.all('Release force', 'push button'), 'the test to be gone')
    editor.shot('pages-live')
    editor.tab('Modbus and modules (3)')
    editor.find('%IW100..106, Value: 0 0 0 0', 'push button')
    editor.click(editor.find('%XIB0..2, Value: 0 0 0 0 0 0 0 0 …', 'push button'))  # eight of its many
    editor.find('Test of %XIB0..2', 'label')
    editor.shot('pages-module')


def scanned(screen):
    """a bus is scanned; the units that answer are offered; a scan is stopped; a bus without an answer says so"""
    if not os.path.exists(os.path.join(BUILD, 'ladder-modbus')):
        return
    device = socket.create_server(('127.0.0.1', 0))
    ports = [device.getsockname()[1], free_port()]
    threading.Thread(target=answer, args=(device, (1, 3, 17)), daemon=True).start()
    text = MAP.replace('10.0.0.20:502 timeout=300ms', '127.0.0.1:%d timeout=20ms' % ports[0]).replace(
        'BUS   yard', 'BUS   quiet modbus-tcp  host=127.0.0.1:%d timeout=9s\nBUS   yard' % ports[1])
    path, io = plant(screen, text)
    editor = Editor(screen, path)
    open_map(editor)
    editor.tab('Modbus and modules (3)')
    editor.click(cell(editor, '%QX40.0, Number'))
    editor.click(editor.find('Scan the bus', 'push button'))
    editor.find('Stop the scan', 'push button')
    editor.find('Scanning “plant”')
    editor.find('Units that answer on “plant”: 1, 3, 17  What comes for 30 is damaged or of another unit: look for two devices')
    editor.shot('pages-scanned')
    editor.click(cell(editor, '%QX40.0, Unit'))
    editor.keys('alt+Down')
    editor.find('17 answers in', 'list item')
    editor.find('exception 2', 'list item')
    offered = sorted(int(found.group(1)) for node in editor.all(role='list item')
                     if (found := re.match(r'(\d+) (answers|.*exception)', node.name)))
    assert offered == [1, 3, 17], offered
    editor.shot('pages-units')
    editor.keys('Down', 'Down', 'Return')
    until(lambda: cell(editor, '%QX40.0, Unit').text() != '1', 'another unit')
    unit = cell(editor, '%QX40.0, Unit').text()
    assert unit in ('3', '17'), unit
    editor.keys('ctrl+s')
    until(lambda: re.search(r'^%%QX40\.0 .*unit=%s\b' % unit, open(io).read(), re.M), 'the unit in the map')
    until(lambda: not editor.all('Units that answer on'), 'the result to go')
    # The units of another bus are not those of this one.
    editor.tab('Buses (5)')
    editor.click(cell(editor, 'quiet, Host'))
    editor.click(editor.find('Scan the bus', 'push button'))
    editor.find('127.0.0.1:%d: Connection refused' % ports[1])
    device.close()
    silent = socket.create_server(('127.0.0.1', ports[1]))
    editor.click(editor.find('Scan the bus', 'push button'))
    editor.find('Scanning “quiet”')
    editor.click(editor.find('Stop the scan', 'push button'))
    editor.find('Scan the bus', 'push button')
    until(lambda: not editor.all('Scanning “quiet”'), 'the scan to end')
    assert not editor.all('Units that answer on'), 'a scan that was stopped has a result'
    silent.close()


def answer(device, units):
    """A gateway of the network behind which some units are: register 0 is 7; unit 17 has no registers, for unit 30
    another one answers."""
    while True:
        try:
            stream = device.accept()[0]
        except OSError:
            return
        while True:
            request = stream.recv(12)
            if len(request) < 12:
                break
            unit = request[6]
            if unit in units or unit == 30:
                unit += unit == 30
                body = bytes([unit, 0x83, 2]) if unit == 17 else bytes([unit, 3, 2, 0, 7])
                stream.sendall(request[:4] + bytes([0, len(body)]) + body)


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def small(screen):
    """1024 x 700 in Chinese: the pages fit, each can be reached"""
    path, _ = plant(screen)
    editor = Chinese(screen, path, ADW_DEBUG_COLOR_SCHEME='prefer-dark')
    editor.find('plant.io', 'label')
    editor.click(min(editor.all('plant.io', 'label'), key=lambda node: node.box()[0]), count=2)
    for page, there in ('模拟量 (3)', '%AIW0, '), ('Modbus 与模块 (3)', '%QX40.0, '), ('总线列表 (4)', 'rs485, '), ('供他人访问 (4)', 'main, '):
        editor.tab(page)
        cell(editor, there)
        editor.shot('pages-chinese-' + page.split()[0])


def narrow(screen):
    """1024 x 700 in German and French: no page makes the window wider than the screen"""
    path, _ = plant(screen, MAP + '%IB201 quality of=%XIB0..2\n')
    for language in 'de', 'fr':
        editor = Foreign(screen, language, path)
        editor.click(min(editor.all('plant.io', 'label'), key=lambda node: node.box()[0]), count=2)
        for name in PAGES:
            name = editor.shown_as(name.split(' (')[0])
            editor.click(until(lambda: [tab for tab in editor.all(name) if tab.name.startswith(name + ' (')], name)[0])
            run = editor.find('Run on this machine…', 'push button')
            left, _top, width, _height = until(run.box, 'the last button')
            assert left + width <= 1024, (language, name, left, width)
        editor.finish()


small.size = narrow.size = '1024x700x24'
pages.quick = 'editor-gtk/iomap'
if __name__ == '__main__':
    main([pages, lines, values, scanned, small, narrow])
