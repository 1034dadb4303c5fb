/* SPDX-License-Identifier: MIT
 *
 * request - a request of a driver with what hal.c knows about its lines.
 *
 * Private to hal.c, which moves levels, and hal_open.c, which finds lines and takes
 * them.
 */
#ifndef HAL_REQUEST_H
#define HAL_REQUEST_H

#include "hal/drivers.h"
#include "hal/hal.h"

struct hal_bit { uint16_t byte; uint8_t mask; }; /* in its area               */

struct hal_request {
	struct request ask;      /* what the driver sees                      */
	struct hal_bit *bit;     /* a line each, as all below                 */
	int64_t *differs_ns;     /* since when the level differs from value;
				    NULL: no line has a debounce              */
	uint64_t debounced;      /* lines with a debounce                     */
	uint64_t differs;        /* lines whose level differs from value      */
	uint64_t invert;         /* lines that are active low                 */
	uint64_t safe;           /* as a program would write it               */
	uint64_t value;          /* as the program sees or wrote it           */
	int64_t written_ns;
	bool is_open;
	bool written;            /* written_ns is set                         */
	bool dirty;              /* the line may not show value               */
	uint8_t failures;        /* in a row, up to HAL_FAILURES              */
};

bool request_in_fault(const struct hal_request *request);
#endif
