/* SPDX-License-Identifier: MIT
 *
 * bench_map - a map of modbus points, made by hand.
 */
#ifndef TESTS_BENCH_MAP_H
#define TESTS_BENCH_MAP_H

#include "hal/channel.h"

#include <string.h>

#define BENCH_POINTS 512

struct bench_map {
	struct iomap map;
	struct io_net net;
	struct io_bus bus;
	struct io_point point[BENCH_POINTS];
	struct io_channel channel[BENCH_POINTS];
};

static inline void bench_map_init(struct bench_map *it)
{
	memset(it, 0, sizeof(*it));
	it->bus = (struct io_bus){ .name = "plant", .kind = BUS_MODBUS_RTU, .port = "/dev/none", .baud = 19200,
				   .parity = 'E', .stop_bits = 1, .timeout_ns = 100000000 };
	it->net = (struct io_net){ .bus = &it->bus, .bus_count = 1 };
	it->map = (struct iomap){ .file = "plant.io", .point = it->point, .net = &it->net };
}

static inline struct io_channel *bench_map_add(struct bench_map *it, int unit, enum io_table table, int reg,
					       enum iec_type type, bool output)
{
	struct io_channel *channel = &it->channel[it->map.count];
	struct io_point *point = &it->point[it->map.count++];

	*channel = (struct io_channel){ .type = type, .raw = type, .bus = 0, .unit_id = (uint8_t)unit,
					.table = table, .reg = (uint16_t)reg, .poll_ns = IO_POLL_NS,
					.refresh_ns = IO_REFRESH_NS, .module = -1,
					.reg_bit = type == IEC_BOOL && table > TABLE_DISCRETE_INPUT ? 0 : -1 };
	*point = (struct io_point){ .driver = DRIVER_modbus, .output = output, .channel = channel };
	return channel;
}
#endif
