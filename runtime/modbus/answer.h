/* SPDX-License-Identifier: MIT
 *
 * answer - what a server answers to a request: only what WINDOW lines of the map declare.
 *
 * Every other address is exception 2, every other function exception 1. It knows no connection; values
 * come and go through two functions.
 */
#ifndef MODBUS_ANSWER_H
#define MODBUS_ANSWER_H

#include "modbus/pdu.h"

struct answer_image {
	/* @first: from 0 on, of window @window. False: the board does not answer. */
	bool (*read)(void *context, int window, uint32_t first, int count, uint16_t *value);
	bool (*write)(void *context, int window, uint32_t first, int count, const uint16_t *value);
	void *context;
};

/** answer_make - the answer of server @serve of @net to @request, whose bytes may be any */
void answer_make(const struct io_net *net, int serve, const struct answer_image *image,
		 const struct pdu *request, struct pdu *answer);
#endif
