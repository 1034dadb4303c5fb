/* SPDX-License-Identifier: MIT
 *
 * test_digest - the published test vectors, whole and in parts.
 */
#include "engine/base/digest.h"
#include "tests/tap.h"

static void crc(void)
{
	uint8_t bytes[32];
	uint32_t part;

	CHECK(digest_crc32c(0, "", 0) == 0);
	CHECK(digest_crc32c(0, "123456789", 9) == 0xe3069283u);
	memset(bytes, 0, sizeof(bytes)); /* RFC 3720 B.4 */
	CHECK(digest_crc32c(0, bytes, 32) == 0x8a9136aau);
	memset(bytes, 0xff, sizeof(bytes));
	CHECK(digest_crc32c(0, bytes, 32) == 0x62a8ab43u);
	for (int i = 0; i < 32; i++)
		bytes[i] = (uint8_t)i;
	CHECK(digest_crc32c(0, bytes, 32) == 0x46dd794eu);
	for (size_t len = 0; len <= 32; len++) { /* whole steps and what is left */
		uint32_t single = 0;

		for (size_t i = 0; i < len; i++)
			single = digest_crc32c(single, bytes + i, 1);
		CHECK(digest_crc32c(0, bytes, len) == single);
	}
	part = digest_crc32c(0, bytes, 7);
	CHECK(digest_crc32c(part, bytes + 7, 25) == 0x46dd794eu);
}

static const char *sha_in_parts(const char *text, size_t len, size_t part)
{
	static char hex[65];
	struct digest_sha256 sha;
	uint8_t out[32];

	digest_sha256_init(&sha);
	for (size_t at = 0; at < len; at += part)
		digest_sha256_add(&sha, text + at,
				  len - at < part ? len - at : part);
	digest_sha256_end(&sha, out);
	digest_hex(out, 32, hex);
	return hex;
}

static void sha(void)
{
	static const char two_blocks[] =
		"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
	static char million[1000000];

	CHECK_TEXT(sha_in_parts("", 0, 1), "e3b0c44298fc1c149afbf4c8996fb924"
					   "27ae41e4649b934ca495991b7852b855");
	CHECK_TEXT(sha_in_parts("abc", 3, 3), "ba7816bf8f01cfea414140de5dae2223"
					      "b00361a396177a9cb410ff61f20015ad");
	for (size_t part = 1; part <= 56; part += 11)
		CHECK_TEXT(sha_in_parts(two_blocks, 56, part),
			   "248d6a61d20638b8e5c026930c3e6039"
			   "a33ce45964ff2167f6ecedd419db06c1");
	memset(million, 'a', sizeof(million));
	CHECK_TEXT(sha_in_parts(million, sizeof(million), 997),
		   "cdc76e5c9914fb9281a1c7e284d73e67"
		   "f1809a48a497200e046d39ccc7112cd0");
	CHECK_TEXT(sha_in_parts(million, sizeof(million), 1000000),
		   "cdc76e5c9914fb9281a1c7e284d73e67"
		   "f1809a48a497200e046d39ccc7112cd0");
}

int main(void)
{
	crc();
	sha();
	return tap_done();
}
