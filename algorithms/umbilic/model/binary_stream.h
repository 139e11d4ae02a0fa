// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <umbilic/core/errors.h>
#include <umbilic/core/types.h>

namespace umbilic {

/// Appends numbers and texts in little-endian to a string of bytes.
class BinaryWriter {
public:
    const std::string& bytes() const { return bytes_; }

    template <class Integer>
    requires std::is_integral_v<Integer>
    void add(Integer value) {
        auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
        for (std::size_t i = 0; i < sizeof(Integer); ++i, bits = static_cast<decltype(bits)>(bits >> 4 >> 4))
            bytes_.push_back(static_cast<char>(bits & 0xff));
    }
    void add_flag(bool value) { add(static_cast<std::uint8_t>(value)); }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(std::string_view text) {
        add(static_cast<std::uint64_t>(text.size()));
        bytes_.append(text);
    }
    template <class Derived>
    void add(const Eigen::MatrixBase<Derived>& matrix) {
        for (Eigen::Index row = 0; row < matrix.rows(); ++row)
            for (Eigen::Index column = 0; column < matrix.cols(); ++column) add(double(matrix(row, column)));
    }
    /// Number of items, then each item by `add_item`.
    template <class Items, class AddItem>
    void add_all(const Items& items, const AddItem& add_item) {
        add(static_cast<std::uint64_t>(items.size()));
        for (const auto& item : items) add_item(item);
    }

private:
    std::string bytes_;
};

/// Reads what BinaryWriter wrote. Every function throws InvalidInput where the bytes end too early or hold a value
/// that is not allowed; nothing is allocated before its bytes are known to be there.
class BinaryReader {
public:
    explicit BinaryReader(std::string_view bytes) : rest_(bytes) {}

    bool at_end() const { return rest_.empty(); }

    template <class Integer>
    Integer integer() {
        std::make_unsigned_t<Integer> bits = 0;
        const std::string_view bytes = take(sizeof(Integer));
        for (std::size_t i = 0; i < sizeof(Integer); ++i)
            bits |= static_cast<decltype(bits)>(static_cast<decltype(bits)>(static_cast<unsigned char>(bytes[i]))
                                                << (8 * i));
        return static_cast<Integer>(bits);
    }
    /// Integer in [low, high].
    int integer_in(int low, int high) {
        const int value = integer<std::int32_t>();
        if (value < low || value > high) throw InvalidInput("binary data: a number is outside its range");
        return value;
    }
    bool flag() {
        const auto value = integer<std::uint8_t>();
        if (value > 1) throw InvalidInput("binary data: a flag is neither 0 nor 1");
        return value == 1;
    }
    double any_number() { return std::bit_cast<double>(integer<std::uint64_t>()); }
    /// Finite number.
    double number() {
        const double value = any_number();
        if (!std::isfinite(value)) throw InvalidInput("binary data: a number is not finite");
        return value;
    }
    std::string text() { return std::string(take(count(1))); }
    template <class Matrix>
    Matrix matrix() {
        Matrix result;
        for (Eigen::Index row = 0; row < result.rows(); ++row)
            for (Eigen::Index column = 0; column < result.cols(); ++column) result(row, column) = number();
        return result;
    }
    /// What add() wrote of a value of the same type.
    void read(std::uint64_t& value) { value = integer<std::uint64_t>(); }
    void read(double& value) { value = number(); }
    void read(std::string& value) { value = text(); }
    template <int rows, int columns>
    void read(Eigen::Matrix<double, rows, columns>& value) {
        value = matrix<Eigen::Matrix<double, rows, columns>>();
    }
    /// Number of items that follow, each at least `item_bytes` long.
    std::size_t count(std::size_t item_bytes) {
        const auto value = integer<std::uint64_t>();
        if (value > rest_.size() / item_bytes) throw InvalidInput("binary data: the bytes end too early");
        return static_cast<std::size_t>(value);
    }
    /// A list of items, each at least `item_bytes` long and read by `read_item`.
    template <class ReadItem>
    auto all(std::size_t item_bytes, const ReadItem& read_item) {
        std::vector<std::decay_t<decltype(read_item())>> result;
        const std::size_t size = count(item_bytes);
        result.reserve(size);
        for (std::size_t i = 0; i < size; ++i) result.push_back(read_item());
        return result;
    }

private:
    std::string_view take(std::size_t size) {
        if (size > rest_.size()) throw InvalidInput("binary data: the bytes end too early");
        const std::string_view result = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return result;
    }

    std::string_view rest_;
};

}  // namespace umbilic
