/* SPDX-License-Identifier: MIT
 *
 * pdu - requests and answers of Modbus as bytes, and values in registers.
 *
 * A PDU is a function code and its data, the same on a serial line and in TCP. All functions are pure:
 * they know no line, no time and no map.
 */
#ifndef MODBUS_PDU_H
#define MODBUS_PDU_H

#include "engine/base/iec.h"
#include "hal/channel.h"

#define PDU_MOST        253  /* bytes                                      */
#define PDU_READ_BITS   2000 /* at most, in one request                    */
#define PDU_READ_WORDS  125
#define PDU_WRITE_BITS  1968
#define PDU_WRITE_WORDS 123
#define PDU_BOTH_WORDS  121  /* written by function 23                     */

enum pdu_function {
	PDU_COILS = 1, PDU_DISCRETE_INPUTS = 2, PDU_HOLDING_REGISTERS = 3, PDU_INPUT_REGISTERS = 4,
	PDU_SET_COIL = 5, PDU_SET_REGISTER = 6, PDU_SET_COILS = 15, PDU_SET_REGISTERS = 16,
	PDU_MASK = 22, PDU_BOTH = 23,
};
enum pdu_exception { PDU_NO_FUNCTION = 1, PDU_NO_ADDRESS = 2, PDU_BAD_VALUE = 3, PDU_FAILURE = 4,
		     PDU_BUSY = 6, PDU_NO_PATH = 10, PDU_NO_TARGET = 11 };
#define PDU_EXCEPTIONS 12 /* numbers from 0 to 11 */

struct pdu {
	uint8_t byte[PDU_MOST];
	int len;
};

static inline uint16_t pdu_word(const uint8_t *at)
{
	return (uint16_t)(at[0] << 8 | at[1]);
}

/* ---- requests ---- */

/** pdu_read - @count coils or registers from @first on. The table says which function. */
void pdu_read(struct pdu *out, enum io_table table, uint16_t first, int count);
/** pdu_set_bits - function 5 for one coil, 15 for more; @many: 15 also for one. */
void pdu_set_bits(struct pdu *out, uint16_t first, const bool *bit, int count, bool many);
/** pdu_set_words - function 6 for one register, 16 for more; @many: 16 also for one. */
void pdu_set_words(struct pdu *out, uint16_t first, const uint16_t *word, int count, bool many);
/** pdu_both - function 23: writes @words registers from @to on, then reads @count from @first on. */
void pdu_both(struct pdu *out, uint16_t first, int count, uint16_t to, const uint16_t *word, int words);
/** pdu_mask - changes the bits of @mask in one register to those of @bits. */
void pdu_mask(struct pdu *out, uint16_t reg, uint16_t mask, uint16_t bits);

/* ---- answers ---- */

enum pdu_fit { PDU_FITS, PDU_EXCEPTION, PDU_WRONG };
/** pdu_check - whether @answer can be the answer to @request: function, length, and what must be repeated
 * @exception: its number, for PDU_EXCEPTION */
enum pdu_fit pdu_check(const struct pdu *request, const struct pdu *answer, int *exception);
/** pdu_bit, pdu_at - coil or register @i of an answer that fits. */
bool pdu_bit(const struct pdu *answer, int i);
uint16_t pdu_at(const struct pdu *answer, int i);

/* ---- values ---- */

/** pdu_words_of - registers that a value of the type takes; 0: it cannot be in registers. */
int pdu_words_of(enum iec_type type);
/** pdu_value - the value in pdu_words_of(type) registers; @channel has type and order. */
union iec_value pdu_value(const struct io_channel *channel, const uint16_t *word);
/** pdu_words - the other way. */
void pdu_words(const struct io_channel *channel, union iec_value value, uint16_t *word);

/** pdu_crc - the check of a frame on a serial line; its low byte is sent first. */
uint16_t pdu_crc(const uint8_t *byte, int len);
#endif
