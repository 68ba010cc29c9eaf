// SPDX-License-Identifier: Apache-2.0
// What ordered maps and shared objects ask of the C++ runtime, whose names these are; the library
// needs no other part of it. Trees stay balanced: no way down is more than twice as long as
// another. in: nodes of a tree -> out: neighbours in its order; a new node in its place.
// docs/flight.md, "Build"
#include <map>
#include <memory>

namespace std {
namespace {

using Node = _Rb_tree_node_base;

/// `right`: the child on the right comes up, else that on the left.
void turn(Node* node, bool right, Node*& root) {
    Node* const up = right ? node->_M_right : node->_M_left;
    Node*& inner = right ? up->_M_left : up->_M_right;
    (right ? node->_M_right : node->_M_left) = inner;
    if (inner != nullptr) inner->_M_parent = node;
    up->_M_parent = node->_M_parent;
    if (node == root)
        root = up;
    else if (node == node->_M_parent->_M_left)
        node->_M_parent->_M_left = up;
    else
        node->_M_parent->_M_right = up;
    inner = node;
    node->_M_parent = up;
}

/// The next node, or the one before. The head, whose parent is the root and which is the root's,
/// stands behind the last and before the first.
Node* beside(Node* node, bool right) {
    Node* child = right ? node->_M_right : node->_M_left;
    if (child != nullptr) {
        while (Node* const next = right ? child->_M_left : child->_M_right) child = next;
        return child;
    }
    Node* up = node->_M_parent;
    while (node == (right ? up->_M_right : up->_M_left)) {
        node = up;
        up = up->_M_parent;
    }
    // From a root without such a child, `node` is the head already.
    return right && node->_M_right == up ? node : up;
}

}  // namespace

Node* _Rb_tree_increment(Node* node) noexcept { return beside(node, true); }
const Node* _Rb_tree_increment(const Node* node) noexcept {
    return beside(const_cast<Node*>(node), true);
}
Node* _Rb_tree_decrement(Node* node) noexcept {
    const bool is_head = node->_M_color == _S_red && node->_M_parent->_M_parent == node;
    return is_head ? node->_M_right : beside(node, false);
}

void _Rb_tree_insert_and_rebalance(const bool left, Node* node, Node* parent, Node& head) noexcept {
    Node*& root = head._M_parent;
    node->_M_parent = parent;
    node->_M_left = node->_M_right = nullptr;
    node->_M_color = _S_red;
    if (parent == &head) {
        root = head._M_left = head._M_right = node;
    } else if (left) {
        parent->_M_left = node;
        if (parent == head._M_left) head._M_left = node;
    } else {
        parent->_M_right = node;
        if (parent == head._M_right) head._M_right = node;
    }
    while (node != root && node->_M_parent->_M_color == _S_red) {
        Node* const above = node->_M_parent->_M_parent;
        const bool is_left = node->_M_parent == above->_M_left;
        Node* const other = is_left ? above->_M_right : above->_M_left;
        if (other != nullptr && other->_M_color == _S_red) {
            node->_M_parent->_M_color = other->_M_color = _S_black;
            above->_M_color = _S_red;
            node = above;
            continue;
        }
        if (node == (is_left ? node->_M_parent->_M_right : node->_M_parent->_M_left)) {
            node = node->_M_parent;
            turn(node, is_left, root);
        }
        node->_M_parent->_M_color = _S_black;
        above->_M_color = _S_red;
        turn(above, !is_left, root);
    }
    root->_M_color = _S_black;
}

// No object here is made by a runtime with types.
bool _Sp_make_shared_tag::_S_eq(const type_info&) noexcept { return false; }

}  // namespace std
