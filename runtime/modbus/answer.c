/* SPDX-License-Identifier: MIT
 *
 * answer - what a server answers, function by function.
 */
#include "modbus/answer.h"

/* One request: what it asks of which server. */
struct inquiry {
	const struct io_net *net;
	int serve;
	const struct answer_image *image;
	const struct pdu *request;
};

static void refuse(const struct pdu *request, struct pdu *answer, enum pdu_exception exception)
{
	answer->byte[0] = (uint8_t)((request->len ? request->byte[0] : 0) | 0x80);
	answer->byte[1] = (uint8_t)exception;
	answer->len = 2;

}

/* The window that has @at, or -1. */
static int window_at(const struct inquiry *of, enum io_table table, uint32_t at)
{
	for (int i = 0; i < of->net->window_count; i++) {
		const struct io_window *window = &of->net->window[i];

		if (window->serve == of->serve && window->table == table && at >= window->first &&
		    at < window->first + window->count)
			return i;
	}
	return -1;
}

/* How many of @count from @at on are in that window. */
static int part(const struct inquiry *of, int window, uint32_t at, int count)
{
	const struct io_window *it = &of->net->window[window];
	const int left = (int)(it->first + it->count - at);

	return left < count ? left : count;
}

/* 0, or an exception: nothing is moved then. */
static int allowed(const struct inquiry *of, enum io_table table, uint32_t first, int count, bool write)
{
	for (int done = 0; done < count;) {
		const int window = window_at(of, table, first + (uint32_t)done);

		if (window < 0 || (write && !of->net->window[window].writable))
			return PDU_NO_ADDRESS;
		done += part(of, window, first + (uint32_t)done, count - done);
	}
	return 0;
}

static int read_all(const struct inquiry *of, enum io_table table, uint32_t first, int count,
		    uint16_t *value)
{
	const int no = allowed(of, table, first, count, false);

	for (int done = 0; !no && done < count;) {
		const uint32_t at = first + (uint32_t)done;
		const int window = window_at(of, table, at);
		const int some = part(of, window, at, count - done);

		if (!of->image->read(of->image->context, window, at - of->net->window[window].first, some,
				     value + done))
			return PDU_FAILURE;
		done += some;
	}
	return no;
}

static int write_all(const struct inquiry *of, enum io_table table, uint32_t first, int count,
		     const uint16_t *value)
{
	const int no = allowed(of, table, first, count, true);

	for (int done = 0; !no && done < count;) {
		const uint32_t at = first + (uint32_t)done;
		const int window = window_at(of, table, at);
		const int some = part(of, window, at, count - done);

		if (!of->image->write(of->image->context, window, at - of->net->window[window].first, some,
				      value + done))
			return PDU_FAILURE;
		done += some;
	}
	return no;
}

/* ---- functions ---- */

static int answer_bits(const struct inquiry *of, enum io_table table, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;
	const int count = of->request->len == 5 ? pdu_word(byte + 3) : 0;
	uint16_t value[64];
	int no;

	if (count < 1 || count > PDU_READ_BITS)
		return PDU_BAD_VALUE;
	no = allowed(of, table, pdu_word(byte + 1), count, false);
	answer->byte[1] = (uint8_t)((count + 7) / 8);
	answer->len = 2 + answer->byte[1];
	for (int done = 0; !no && done < count; done += 64) {
		const int some = count - done < 64 ? count - done : 64;

		no = read_all(of, table, pdu_word(byte + 1) + (uint32_t)done, some, value);
		for (int i = 0; !no && i < (some + 7) / 8; i++)
			answer->byte[2 + done / 8 + i] = 0;
		for (int i = 0; !no && i < some; i++)
			if (value[i])
				answer->byte[2 + (done + i) / 8] |= (uint8_t)(1 << i % 8);
	}
	return no;
}

static int answer_words(const struct inquiry *of, enum io_table table, uint16_t first, int count,
			struct pdu *answer)
{
	uint16_t value[PDU_READ_WORDS];
	int no;

	if (count < 1 || count > PDU_READ_WORDS)
		return PDU_BAD_VALUE;
	no = read_all(of, table, first, count, value);
	answer->byte[1] = (uint8_t)(2 * count);
	answer->len = 2 + 2 * count;
	for (int i = 0; i < count; i++) {
		answer->byte[2 + 2 * i] = (uint8_t)(value[i] >> 8);
		answer->byte[3 + 2 * i] = (uint8_t)value[i];
	}
	return no;
}

static int repeat(const struct inquiry *of, int len, struct pdu *answer)
{
	for (int i = 0; i < len; i++)
		answer->byte[i] = of->request->byte[i];
	answer->len = len;
	return 0;
}

static int set_one(const struct inquiry *of, enum io_table table, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;
	uint16_t value = of->request->len == 5 ? pdu_word(byte + 3) : 1;
	int no;

	if (of->request->len != 5 || (table == TABLE_COIL && value != 0 && value != 0xff00))
		return PDU_BAD_VALUE;
	if (table == TABLE_COIL)
		value = value != 0;
	no = write_all(of, table, pdu_word(byte + 1), 1, &value);
	return no ? no : repeat(of, 5, answer);
}

static int set_coils(const struct inquiry *of, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;
	const int count = of->request->len >= 6 ? pdu_word(byte + 3) : 0;
	uint16_t value[64];
	int no;

	if (count < 1 || count > PDU_WRITE_BITS || byte[5] != (count + 7) / 8 ||
	    of->request->len != 6 + byte[5])
		return PDU_BAD_VALUE;
	no = allowed(of, TABLE_COIL, pdu_word(byte + 1), count, true);
	for (int done = 0; !no && done < count; done += 64) {
		const int some = count - done < 64 ? count - done : 64;

		for (int i = 0; i < some; i++)
			value[i] = byte[6 + (done + i) / 8] >> i % 8 & 1;
		no = write_all(of, TABLE_COIL, pdu_word(byte + 1) + (uint32_t)done, some, value);
	}
	return no ? no : repeat(of, 5, answer);
}

/* Registers from @head on in the request: first, count, bytes, values. */
static int set_words(const struct inquiry *of, int head, int most)
{
	const uint8_t *byte = of->request->byte;
	const int count = of->request->len >= head + 5 ? pdu_word(byte + head + 2) : 0;
	uint16_t value[PDU_WRITE_WORDS];

	if (count < 1 || count > most || byte[head + 4] != 2 * count ||
	    of->request->len != head + 5 + 2 * count)
		return PDU_BAD_VALUE;
	for (int i = 0; i < count; i++)
		value[i] = pdu_word(byte + head + 5 + 2 * i);
	return write_all(of, TABLE_HOLDING_REGISTER, pdu_word(byte + head), count, value);
}

static int set_mask(const struct inquiry *of, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;
	uint16_t value;
	int no;

	if (of->request->len != 7)
		return PDU_BAD_VALUE;
	no = allowed(of, TABLE_HOLDING_REGISTER, pdu_word(byte + 1), 1, true);
	if (!no)
		no = read_all(of, TABLE_HOLDING_REGISTER, pdu_word(byte + 1), 1, &value);
	if (no)
		return no;
	value = (uint16_t)((value & pdu_word(byte + 3)) | (pdu_word(byte + 5) & ~pdu_word(byte + 3)));
	no = write_all(of, TABLE_HOLDING_REGISTER, pdu_word(byte + 1), 1, &value);
	return no ? no : repeat(of, 7, answer);
}

/* The write comes first; nothing is written if the read is not allowed. */
static int both(const struct inquiry *of, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;
	const int count = of->request->len >= 10 ? pdu_word(byte + 3) : 0;
	int no;

	if (count < 1 || count > PDU_READ_WORDS)
		return PDU_BAD_VALUE;
	no = allowed(of, TABLE_HOLDING_REGISTER, pdu_word(byte + 1), count, false);
	if (!no)
		no = set_words(of, 5, PDU_BOTH_WORDS);
	return no ? no : answer_words(of, TABLE_HOLDING_REGISTER, pdu_word(byte + 1), count, answer);
}

static int read_words(const struct inquiry *of, enum io_table table, struct pdu *answer)
{
	const uint8_t *byte = of->request->byte;

	return of->request->len == 5 ?
	       answer_words(of, table, pdu_word(byte + 1), pdu_word(byte + 3), answer) : PDU_BAD_VALUE;
}

static int set_registers(const struct inquiry *of, struct pdu *answer)
{
	const int no = set_words(of, 1, PDU_WRITE_WORDS);

	return no ? no : repeat(of, 5, answer);
}

static int act(const struct inquiry *of, struct pdu *answer)
{
	switch (of->request->len ? of->request->byte[0] : 0) {
	case PDU_COILS: return answer_bits(of, TABLE_COIL, answer);
	case PDU_DISCRETE_INPUTS: return answer_bits(of, TABLE_DISCRETE_INPUT, answer);
	case PDU_HOLDING_REGISTERS: return read_words(of, TABLE_HOLDING_REGISTER, answer);
	case PDU_INPUT_REGISTERS: return read_words(of, TABLE_INPUT_REGISTER, answer);
	case PDU_SET_COIL: return set_one(of, TABLE_COIL, answer);
	case PDU_SET_REGISTER: return set_one(of, TABLE_HOLDING_REGISTER, answer);
	case PDU_SET_COILS: return set_coils(of, answer);
	case PDU_SET_REGISTERS: return set_registers(of, answer);
	case PDU_MASK: return set_mask(of, answer);
	case PDU_BOTH: return both(of, answer);
	default: return PDU_NO_FUNCTION;
	}
}

void answer_make(const struct io_net *net, int serve, const struct answer_image *image,
		 const struct pdu *request, struct pdu *answer)
{
	const struct inquiry of = { .net = net, .serve = serve, .image = image, .request = request };
	int no;

	answer->byte[0] = request->len ? request->byte[0] : 0;
	no = act(&of, answer);
	if (no)
		refuse(request, answer, (enum pdu_exception)no);
}
