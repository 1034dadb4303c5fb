# SPDX-License-Identifier: MIT
"""far - devices of Modbus that other people's programs simulate (pymodbus), and wires that damage frames."""
import asyncio
import os
import pty
import select
import threading
import time
import tty

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer
from pymodbus.transaction import ModbusRtuFramer

TABLES = {'coil': 1, 'discrete-input': 2, 'holding-register': 3, 'input-register': 4}


class Block(ModbusSequentialDataBlock):
    """Values from address 0 on. It counts requests, and may have holes."""

    def __init__(self, size):
        super().__init__(0, [0] * size)
        self.reads = self.writes = 0
        self.missing = set()

    def validate(self, address, count=1):
        return super().validate(address, count) and not any(at in self.missing for at in range(address, address + count))

    def getValues(self, address, count=1):
        self.reads += 1
        return super().getValues(address, count)

    def setValues(self, address, values):
        self.writes += 1
        super().setValues(address, values)


class Slave(ModbusSlaveContext):
    """A unit that counts how often it reads for each function."""

    def __init__(self, **blocks):
        super().__init__(zero_mode=True, **blocks)
        self.functions = {}

    def getValues(self, fc_as_hex, address, count=1):
        self.functions[fc_as_hex] = self.functions.get(fc_as_hex, 0) + 1
        return super().getValues(fc_as_hex, address, count)


class Units:
    """Units of one bus, served by pymodbus in a thread of its own."""

    def __init__(self, numbers, size=200):
        self.block = {n: {table: Block(size) for table in TABLES} for n in numbers}
        self.slave = {n: Slave(co=b['coil'], di=b['discrete-input'], hr=b['holding-register'], ir=b['input-register'])
                      for n, b in self.block.items()}
        self.context = ModbusServerContext(single=False, slaves=self.slave)
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.loop.run_forever, daemon=True)
        self.thread.start()
        self.server, self.address = None, '127.0.0.1'

    def run(self, what):
        return asyncio.run_coroutine_threadsafe(what, self.loop).result(20)

    def tcp(self, port):
        async def begin():
            self.server = ModbusTcpServer(self.context, address=(self.address, port), allow_reuse_address=True)
            self.task = asyncio.ensure_future(self.server.serve_forever())
            await self.server.serving
        self.run(begin())
        return self

    def rtu(self, device, baud=19200):
        async def begin():
            self.server = ModbusSerialServer(self.context, framer=ModbusRtuFramer, port=device, baudrate=baud,
                                             ignore_missing_slaves=True)
            await self.server.start()
        self.run(begin())
        return self

    def stop(self):
        """The server and its connections end."""
        async def end():
            if isinstance(self.server, ModbusSerialServer):
                await self.server.shutdown()
            else:
                await self.server.server_close()
                for handler in list(self.server.active_connections.values()):
                    handler.cancel()
                self.task.cancel()
        if self.server:
            self.run(end())
        self.server = None

    def close(self):
        self.stop()
        self.loop.call_soon_threadsafe(self.loop.stop)

    def set(self, unit, table, first, *values):
        block = self.block[unit][table]
        block.values[first:first + len(values)] = values

    def get(self, unit, table, first, count=1):
        values = self.block[unit][table].values[first:first + count]
        return values[0] if count == 1 else values


class Wire:
    """A serial line between two pseudo-terminals: `ours` and `theirs`. What the units answer goes through damage()."""

    def __init__(self):
        self.ends = [pty.openpty(), pty.openpty()]
        for _master, slave in self.ends:
            tty.setraw(slave)
        self.ours, self.theirs = (os.ttyname(slave) for _master, slave in self.ends)
        self.damage = None      # (frame) -> [(seconds, bytes)]
        self.down = False       # the cable is out
        self.seen = 0           # frames of units
        self.ended = False
        self.later = []
        self.thread = threading.Thread(target=self.pump, daemon=True)
        self.thread.start()

    def answer(self, data):
        self.seen += 1
        now = time.monotonic()
        for delay, piece in self.damage(data) if self.damage else [(0, data)]:
            self.later.append((now + delay, piece))

    def pump(self):
        up, down = self.ends[0][0], self.ends[1][0]
        while not self.ended:
            now = time.monotonic()
            for entry in sorted(self.later):
                if entry[0] <= now:
                    self.later.remove(entry)
                    if not self.down:
                        os.write(up, entry[1])
            wait = min([0.05] + [max(0, at - now) for at, _piece in self.later])
            for fd in select.select([up, down], [], [], wait)[0]:
                data = os.read(fd, 4096)
                if self.down:
                    continue
                if fd == up:
                    os.write(down, data)
                else:
                    self.answer(data)

    def close(self):
        self.ended = True
        self.thread.join()
        for master, slave in self.ends:
            os.close(master)
            os.close(slave)
