/* SPDX-License-Identifier: MIT
 *
 * test_pdu - requests, answers and values byte by byte.
 */
#include "modbus/pdu.h"
#include "tests/tap.h"

static bool is(const struct pdu *pdu, const char *hex)
{
	char text[3 * PDU_MOST] = "";

	for (int i = 0; i < pdu->len; i++)
		snprintf(text + 3 * i, sizeof(text) - (size_t)(3 * i), "%02x ", pdu->byte[i]);
	if (pdu->len)
		text[3 * pdu->len - 1] = '\0';
	if (strcmp(text, hex) != 0)
		printf("# %s\n", text);
	return strcmp(text, hex) == 0;
}

/* The examples of the specification of the application protocol, 6.1 to 6.16. */
static void test_requests_are_those_of_the_specification(void)
{
	const bool coils[] = { 1, 0, 1, 1, 0, 0, 1, 1, 1, 0 };
	const uint16_t words[] = { 0x000a, 0x0102 };
	struct pdu pdu;

	pdu_read(&pdu, TABLE_COIL, 0x13, 0x13);
	CHECK(is(&pdu, "01 00 13 00 13"));
	pdu_read(&pdu, TABLE_DISCRETE_INPUT, 0xc4, 0x16);
	CHECK(is(&pdu, "02 00 c4 00 16"));
	pdu_read(&pdu, TABLE_HOLDING_REGISTER, 0x6b, 3);
	CHECK(is(&pdu, "03 00 6b 00 03"));
	pdu_read(&pdu, TABLE_INPUT_REGISTER, 8, 1);
	CHECK(is(&pdu, "04 00 08 00 01"));
	pdu_set_bits(&pdu, 0xac, coils, 1, false);
	CHECK(is(&pdu, "05 00 ac ff 00"));
	pdu_set_bits(&pdu, 0xac, coils + 1, 1, false);
	CHECK(is(&pdu, "05 00 ac 00 00"));
	pdu_set_words(&pdu, 1, words, 1, false);
	CHECK(is(&pdu, "06 00 01 00 0a"));
	pdu_set_bits(&pdu, 0x13, coils, 10, false);
	CHECK(is(&pdu, "0f 00 13 00 0a 02 cd 01"));
	pdu_set_bits(&pdu, 0x13, coils, 1, true);
	CHECK(is(&pdu, "0f 00 13 00 01 01 01"));
	pdu_set_words(&pdu, 1, words, 2, false);
	CHECK(is(&pdu, "10 00 01 00 02 04 00 0a 01 02"));
	pdu_mask(&pdu, 4, 0x000d, 0x0005);
	CHECK(is(&pdu, "16 00 04 ff f2 00 05"));
}

/* Each answer but the right one is wrong: another function, one byte less or more, another echo. */
static void test_only_the_right_answer_fits(void)
{
	const bool coils[3] = { true, false, true };
	const uint16_t words[3] = { 1, 2, 3 };
	struct pdu request[8];
	int exception, wrong = 0, tried = 0;

	pdu_read(&request[0], TABLE_COIL, 3, 9);
	pdu_read(&request[1], TABLE_DISCRETE_INPUT, 3, 8);
	pdu_read(&request[2], TABLE_HOLDING_REGISTER, 3, 2);
	pdu_read(&request[3], TABLE_INPUT_REGISTER, 3, 125);
	pdu_set_bits(&request[4], 3, coils, 3, false);
	pdu_set_bits(&request[5], 3, coils, 1, false);
	pdu_set_words(&request[6], 3, words, 3, false);
	pdu_mask(&request[7], 3, 1, 1);
	for (int i = 0; i < 8; i++) {
		static const int bytes[] = { 2, 1, 4, 250 };
		struct pdu right = { .len = i < 4 ? 2 + bytes[i] : i == 7 ? 7 : 5 }, other;

		memcpy(right.byte, request[i].byte, 7);
		if (i < 4)
			right.byte[1] = (uint8_t)bytes[i];
		CHECK(pdu_check(&request[i], &right, &exception) == PDU_FITS && exception == 0);
		other = (struct pdu){ .len = 2, .byte = { request[i].byte[0] | 0x80, 2 } };
		CHECK(pdu_check(&request[i], &other, &exception) == PDU_EXCEPTION && exception == 2);
		for (int len = 0; len < PDU_MOST; len++, tried++) {
			other = right;
			other.len = len;
			wrong += len == right.len || pdu_check(&request[i], &other, &exception) == PDU_WRONG;
		}
		for (int at = 0; at < (i < 4 ? 2 : right.len); at++, tried++) {
			other = right;
			other.byte[at] ^= 1;
			wrong += pdu_check(&request[i], &other, &exception) == PDU_WRONG;
		}
	}
	CHECK(wrong == tried && tried > 2000);
}

static void test_values_come_back_in_each_order(void)
{
	static const struct { enum iec_type type; int64_t i; } whole[] = {
		{ IEC_SINT, -1 }, { IEC_SINT, 127 }, { IEC_USINT, 255 }, { IEC_BYTE, 200 }, { IEC_INT, -32768 },
		{ IEC_UINT, 65535 }, { IEC_WORD, 0x1234 }, { IEC_DINT, -2 }, { IEC_UDINT, 4000000000 },
		{ IEC_DWORD, 0x12345678 }, { IEC_LINT, INT64_MIN }, { IEC_LWORD, 0x123456789abcdef0 },
	};
	static const uint16_t first[] = { 0x1234, 0x5678, 0x3412, 0x7856 },
			      second[] = { 0x5678, 0x1234, 0x7856, 0x3412 };
	int good = 0, tried = 0;

	for (int order = 0; order < 4; order++) {
		struct io_channel channel = { .word_swapped = order & 1, .byte_swapped = order & 2 };
		const union iec_value real = { .r = -0.15625 };
		uint16_t word[4];

		for (size_t i = 0; i < sizeof(whole) / sizeof(whole[0]); i++, tried++) {
			channel.raw = whole[i].type;
			pdu_words(&channel, (union iec_value){ .i = whole[i].i }, word);
			good += pdu_value(&channel, word).i == whole[i].i;
		}
		channel.raw = IEC_REAL;
		pdu_words(&channel, real, word);
		CHECK(pdu_value(&channel, word).r == real.r);
		channel.raw = IEC_LREAL;
		pdu_words(&channel, real, word);
		CHECK(pdu_value(&channel, word).r == real.r);
		channel.raw = IEC_DWORD;
		pdu_words(&channel, (union iec_value){ .i = 0x12345678 }, word);
		CHECK(word[0] == first[order] && word[1] == second[order]);
	}
	CHECK(good == tried && tried == 48);
	CHECK(pdu_words_of(IEC_BOOL) == 0 && pdu_words_of(IEC_STRING) == 0 && pdu_words_of(IEC_SINT) == 1 &&
	      pdu_words_of(IEC_UINT) == 1 && pdu_words_of(IEC_REAL) == 2 && pdu_words_of(IEC_LREAL) == 4);
}

/* The example of the specification of the serial line, 6.2.2. */
static void test_the_check_of_a_frame(void)
{
	const uint8_t frame[] = { 0x02, 0x07, 0x41, 0x12 };

	CHECK(pdu_crc(frame, 2) == 0x1241 && (frame[2] | frame[3] << 8) == pdu_crc(frame, 2));
}

int main(void)
{
	test_requests_are_those_of_the_specification();
	test_only_the_right_answer_fits();
	test_values_come_back_in_each_order();
	test_the_check_of_a_frame();
	return tap_done();
}
