/* SPDX-License-Identifier: MIT
 *
 * request - a request of a driver with the bits, debounce and safe values of its lines.
 * Private to hal.c and hal_open.c.
 */
#ifndef HAL_REQUEST_H
#define HAL_REQUEST_H

#include "hal/drivers.h"
#include "hal/hal.h"

/* In its area; mask 0: no point of the map has the line. */
struct hal_bit { uint16_t byte; uint8_t mask; };

struct hal_request {
	struct request ask;      /* passed to the driver                      */
	struct hal_bit *bit;     /* per line                                  */
	int64_t *differs_ns;     /* per line: since when the level differs    */
	uint64_t debounced;      /* lines with a debounce                     */
	uint64_t differs;        /* lines whose level differs from value      */
	uint64_t invert;         /* lines that are active low                 */
	uint64_t safe;           /* safe values, before inversion             */
	uint64_t hold;           /* lines that keep their last value instead  */
	uint64_t idle;           /* lines that no point of the map has          */
	uint64_t kept;           /* values of idle lines                      */
	struct hal_request *twin; /* that of the other map with the same lines; or NULL */
	uint64_t value;          /* values that the program reads or wrote    */
	int64_t written_ns;
	bool is_open;
	bool written;            /* written_ns is set                         */
	bool dirty;              /* the level may differ from value           */
	uint8_t failures;        /* in a row, up to HAL_FAILURES              */
};

bool request_in_fault(const struct hal_request *request);
/** request_safe - the values that make an output safe now, before inversion. Scan-safe: yes. */
uint64_t request_safe(const struct hal_request *request);
/** request_levels - @values as levels at the pins, and levels as values: lines that are active low are
 * inverted. Scan-safe: yes. */
static inline uint64_t request_levels(const struct hal_request *request, uint64_t values)
{
	return values ^ request->invert;
}
#endif
