/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A kernel, compiled for a variant, that does DMA: spu_mfcio.h declares all of its words there, too, before or after
 * vector.h. */
#include "spu_mfcio.h"
#include "support/suite.h"

#include "vector.h"

#include "support/test.h"

static cgt_spu_dma given[2];
static unsigned count;
static uint32_t written[2];

static void dma(void *self, const cgt_spu_dma *command)
{
    (void)self;
    given[count++ % 2] = *command;
}

static void write_channel(void *self, unsigned channel, uint32_t value)
{
    (void)self;
    written[channel == MFC_WrTagUpdate] = value;
}

static uint32_t read_channel(void *self, unsigned channel)
{
    (void)self;
    return channel == MFC_RdTagStat ? 8 : 0;
}

TEST(words_in_a_kernel)
{
    static _Alignas(64) float data[CGT_LANES * 4];
    static const cgt_spu_host host = {.dma = dma, .write_channel = write_channel, .read_channel = read_channel};
    const cgt_spu_host *const before = cgt_spu_set_host(&host);
    mfc_get(data, 0x10000, sizeof data, 3, 0, 0);
    mfc_write_tag_mask(1 << 3);
    assert_int_equal(mfc_read_tag_status_all(), 8);
    spux_store(data, spux_vfloat(2.f));
    mfc_putf(data, 0x10000, sizeof data, 3, 0, 0);
    cgt_spu_set_host(before);
    assert_int_equal(count, 2);
    assert_true(given[0].ls == data && given[0].command == MFC_GET_CMD && given[0].size == sizeof data);
    assert_true(given[1].ls == data && given[1].command == MFC_PUTF_CMD && given[1].eal == 0x10000);
    assert_true(written[0] == 8 && written[1] == MFC_TAG_UPDATE_ALL);
    assert_true(data[CGT_LANES - 1] == 2.f);
}

VARIANT_SUITE("test_kernel_dma", NULL, NULL)
