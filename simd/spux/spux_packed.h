/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How spux_compress moves the bytes of four lanes, for machines that look bytes up by their numbers. */
#ifndef CGT_SPUX_PACKED_H
#define CGT_SPUX_PACKED_H

/* The 16 byte numbers of the lanes that are 1 in bits, side by side, then numbers that give zero. */
CGT_SPU_INLINE const uint8_t *cgt_spux_packed_bytes(unsigned bits)
{
#define LANE_(i) 4 * (i), 4 * (i) + 1, 4 * (i) + 2, 4 * (i) + 3
#define NONE_ 128, 128, 128, 128
    static const _Alignas(16)
        uint8_t packed[16][16] = {{NONE_, NONE_, NONE_, NONE_},          {LANE_(0), NONE_, NONE_, NONE_},
                                  {LANE_(1), NONE_, NONE_, NONE_},       {LANE_(0), LANE_(1), NONE_, NONE_},
                                  {LANE_(2), NONE_, NONE_, NONE_},       {LANE_(0), LANE_(2), NONE_, NONE_},
                                  {LANE_(1), LANE_(2), NONE_, NONE_},    {LANE_(0), LANE_(1), LANE_(2), NONE_},
                                  {LANE_(3), NONE_, NONE_, NONE_},       {LANE_(0), LANE_(3), NONE_, NONE_},
                                  {LANE_(1), LANE_(3), NONE_, NONE_},    {LANE_(0), LANE_(1), LANE_(3), NONE_},
                                  {LANE_(2), LANE_(3), NONE_, NONE_},    {LANE_(0), LANE_(2), LANE_(3), NONE_},
                                  {LANE_(1), LANE_(2), LANE_(3), NONE_}, {LANE_(0), LANE_(1), LANE_(2), LANE_(3)}};
#undef LANE_
#undef NONE_
    return packed[bits];
}

#endif
